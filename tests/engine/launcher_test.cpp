// The script ./tessera, in a checkout of its own whose cmake, ctest and dpkg-query are stand-ins
// that note how they were called.

#include <algorithm>
#include <fstream>

#include <catch2/catch.hpp>

#include "tests/engine/program.h"

using namespace tessera;

namespace {

namespace fs = std::filesystem;

constexpr const char* fake_cmake = R"(#!/bin/bash
echo "cmake $*" >>"$CALLS"
if [[ $1 == --build ]]; then
  sleep "${BUILD_SECONDS:-0}"
  [[ ! -e $CALLS.broken ]] || exit 1
  printf '#!/bin/bash\necho "ran $*"\n' >"$2/tessera"
  chmod +x "$2/tessera"
else
  mkdir -p build && touch build/build.ninja
  echo "CMAKE_HOME_DIRECTORY:INTERNAL=$PWD" >build/CMakeCache.txt
fi
)";

constexpr const char* fake_dpkg_query = R"(#!/bin/bash
[[ -e $CALLS.missing ]] || echo "installed bash"
)";

class Checkout {
 public:
  explicit Checkout(const std::string& name) : folder_(name) {
    for (const char* source : {"base", "images", "cameras", "scenes/examples", "dice", "hide",
                               "shade", "rays", "reconstruct", "engine", "trade", "report",
                               "bench", "tests"}) {
      folder_.write(std::string("checkout/") + source + "/part.cpp", "");
    }
    folder_.write("checkout/CMakeLists.txt", "");
    folder_.write("checkout/CMakePresets.json", "");
    folder_.write("checkout/cmake/packages.txt", "# a comment\nbash\n");
    folder_.write("checkout/cmake/commands.txt", "# a comment\ncat: coreutils all\n");
    fs::copy_file(TESSERA_SOURCE_DIR "/tessera", path("tessera"));
    tool("cmake", fake_cmake);
    tool("dpkg-query", fake_dpkg_query);
    tool("apt-get", "#!/bin/bash\necho \"apt-get $*\" >>\"$CALLS\"\nrm -f \"$CALLS.missing\"\n");
    tool("sudo", "#!/bin/bash\nexec \"$@\"\n");
    tool("ctest", "#!/bin/bash\necho \"100% tests passed ($*)\"\n");
  }

  std::string path(const std::string& name) const { return folder_ / ("checkout/" + name); }

  // Waits until the clock of files, which may be coarse, is past the last build.
  void let_clock_pass() const {
    const auto built = fs::last_write_time(path("build/stamps/tessera"));
    const fs::path probe = folder_.path() / "clock";
    do {
      std::ofstream(probe) << "x";
    } while (fs::last_write_time(probe) <= built);
  }

  Process start(const std::vector<std::string>& arguments, const std::string& script,
                const std::string& build_seconds = "0") const {
    std::vector<std::string> all{"/bin/bash", script};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return Process(all, folder_,
                   {"PATH=" + (folder_ / "bin") + ":/usr/bin:/bin", "CALLS=" + calls_file(),
                    "BUILD_SECONDS=" + build_seconds});
  }
  ProgramResult run(const std::vector<std::string>& arguments) const {
    return start(arguments, path("tessera")).wait();
  }

  std::string calls_file() const { return folder_ / "calls"; }
  // Lines noted by the stand-ins that begin with `word`.
  int calls(const std::string& word) const {
    std::ifstream stream(calls_file());
    int count = 0;
    for (std::string line; std::getline(stream, line);) count += line.starts_with(word);
    return count;
  }
  void forget_calls() const { fs::remove(calls_file()); }
  const TemporaryFolder& folder() const { return folder_; }

 private:
  void tool(const std::string& name, const std::string& text) const {
    fs::permissions(folder_.write("bin/" + name, text), fs::perms::owner_all);
  }

  TemporaryFolder folder_;
};

}  // namespace

TEST_CASE("the first call configures and builds, the next goes straight to the program") {
  const Checkout checkout("tessera launcher with blanks");
  ProgramResult result = checkout.run({"render", "a b.rib", "-o", "x"});
  CHECK(result.exit_code == 0);
  CHECK(result.out == "ran render a b.rib -o x\n");
  CHECK(checkout.calls("cmake --preset release") == 1);
  CHECK(checkout.calls("cmake --build") == 1);
  CHECK(checkout.calls("apt-get") == 0);

  checkout.forget_calls();
  result = checkout.run({"info", "s.rib"});
  CHECK(result.out == "ran info s.rib\n");
  CHECK(result.err.empty());
  CHECK(checkout.calls("") == 0);
}

TEST_CASE("changed, added and deleted sources are built") {
  const Checkout checkout("tessera-launcher");
  REQUIRE(checkout.run({"render"}).exit_code == 0);
  // Whether the next call builds, once.
  const auto rebuilds = [&] {
    checkout.forget_calls();
    CHECK(checkout.run({"render"}).exit_code == 0);
    const int builds = checkout.calls("cmake --build");
    CHECK(checkout.run({"render"}).exit_code == 0);
    CHECK(checkout.calls("cmake --build") == builds);
    CHECK(checkout.calls("cmake --preset") == 0);
    return builds == 1;
  };
  CHECK_FALSE(rebuilds());
  const std::string part = checkout.path("hide/part.cpp"), added = checkout.path("dice/new.cpp");
  checkout.let_clock_pass();
  std::ofstream(part) << "x";
  CHECK(rebuilds());
  checkout.let_clock_pass();
  std::ofstream(added) << "x";
  CHECK(rebuilds());
  checkout.let_clock_pass();
  fs::remove(added);
  CHECK(rebuilds());
  checkout.let_clock_pass();
  std::ofstream(checkout.path("scenes/examples/new.rib")) << "x";
  CHECK_FALSE(rebuilds());
}

TEST_CASE("after a failed build nothing runs, and the next call builds again") {
  const Checkout checkout("tessera-launcher");
  std::ofstream(checkout.calls_file() + ".broken") << "x";
  ProgramResult result = checkout.run({"render"});
  CHECK(result.exit_code == 1);
  CHECK(result.out.empty());
  CHECK(result.err.find("error: the build failed") != std::string::npos);
  fs::remove(checkout.calls_file() + ".broken");
  result = checkout.run({"render"});
  CHECK(result.exit_code == 0);
  CHECK(result.out == "ran render\n");
}

TEST_CASE("missing packages are installed and named") {
  const Checkout checkout("tessera-launcher");
  std::ofstream(checkout.calls_file() + ".missing") << "x";
  const ProgramResult result = checkout.run({"render"});
  CHECK(result.exit_code == 0);
  CHECK(result.err.find("Installing Debian packages: bash") != std::string::npos);
  CHECK(checkout.calls("apt-get update") == 1);
  CHECK(checkout.calls("apt-get install -q -y") == 1);
}

TEST_CASE("the package of a command is installed for the targets that need it, where it is missing") {
  const Checkout checkout("tessera-launcher");
  std::ofstream(checkout.path("cmake/commands.txt"))
      << "# a comment\ncat: coreutils tessera all\nno-such-command-here: a-package tessera all\n"
         "nor-this-one: b-package all\n";
  const ProgramResult render = checkout.run({"render"});
  CHECK(render.exit_code == 0);
  CHECK(render.err.find("Installing Debian packages: a-package\n") != std::string::npos);
  CHECK(checkout.calls("apt-get install -q -y --no-install-recommends a-package") == 1);
  const ProgramResult test = checkout.run({"test"});
  CHECK(test.err.find("Installing Debian packages: a-package b-package\n") != std::string::npos);
}

TEST_CASE("the script works through a symbolic link and from a moved checkout") {
  const Checkout checkout("tessera-launcher");
  const std::string link = checkout.folder() / "link";
  fs::create_symlink(checkout.path("tessera"), link);
  CHECK(checkout.start({"render", "x"}, link).wait().out == "ran render x\n");
  CHECK(checkout.calls("cmake --build") == 1);

  const fs::path moved = checkout.folder().path() / "moved";
  fs::rename(checkout.path(""), moved);
  std::ofstream(moved / "hide/part.cpp") << "x";
  CHECK(checkout.start({"render", "x"}, (moved / "tessera").string()).wait().exit_code == 0);
  CHECK(checkout.calls("cmake --preset release --fresh") == 1);
}

TEST_CASE("of two calls at once one builds and both run") {
  const Checkout checkout("tessera-launcher");
  Process first = checkout.start({"render", "1"}, checkout.path("tessera"), "0.5");
  Process second = checkout.start({"render", "2"}, checkout.path("tessera"), "0.5");
  CHECK(first.wait().out == "ran render 1\n");
  CHECK(second.wait().out == "ran render 2\n");
  CHECK(checkout.calls("cmake --build") == 1);
}

TEST_CASE("test builds everything and ends with the summary of the tests") {
  const Checkout checkout("tessera-launcher");
  const ProgramResult result = checkout.run({"test", "-R", "x"});
  CHECK(result.exit_code == 0);
  CHECK(checkout.calls("cmake --build") == 1);
  CHECK(result.out.find("100% tests passed") != std::string::npos);
  CHECK(result.out.find("-R x") != std::string::npos);
}

TEST_CASE("help and unknown commands build nothing") {
  const Checkout checkout("tessera-launcher");
  CHECK(checkout.run({"--help"}).exit_code == 0);
  CHECK(checkout.run({"--help"}).out.find("render") != std::string::npos);
  const ProgramResult unknown = checkout.run({"rendr"});
  CHECK(unknown.exit_code == 2);
  CHECK(unknown.err.find("no command 'rendr'") != std::string::npos);
  CHECK(checkout.run({}).exit_code == 2);
  CHECK(checkout.calls("") == 0);
}
