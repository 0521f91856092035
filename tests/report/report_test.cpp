#include <catch2/catch.hpp>

#include <cstdlib>
#include <fstream>
#include <iterator>

#include "base/error.h"
#include "images/exr.h"
#include "report/embedding.h"
#include "report/page_template.h"
#include "report/report.h"
#include "tests/report/fixture.h"

namespace tessera {
namespace {

using Json = nlohmann::ordered_json;
using Catch::Matchers::Contains;

std::string content_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

size_t occurrences(std::string_view text, std::string_view part) {
  size_t number = 0;
  for (size_t at = text.find(part); at != std::string_view::npos; at = text.find(part, at + 1))
    ++number;
  return number;
}

/// What a browser finds in the script element `id`: all up to the next "</script", as HTML has it.
std::string element_text(const std::string& html, const std::string& id) {
  const size_t name = html.find("id=\"" + id + "\"");
  REQUIRE(name != std::string::npos);
  const size_t start = html.find('>', name) + 1;
  return html.substr(start, html.find("</script", start) - start);
}

std::vector<std::string> keys_of(const std::vector<ReportImage>& images) {
  std::vector<std::string> keys;
  for (const ReportImage& image : images) keys.push_back(image.key);
  return keys;
}

}  // namespace

// The browser test starts this case with a folder of its own and opens the page it finds there.
TEST_CASE("A report holds its table and images, whatever its text says") {
  fixture::TemporaryFolder temporary;
  const char* given = std::getenv("TESSERA_REPORT_FIXTURE");
  const std::filesystem::path folder = given ? std::filesystem::path(given) : temporary.path();
  fixture::write(folder);
  const Json table = fixture::table();
  write_report(table, folder, folder / "page.html");

  const std::string html = content_of(folder / "page.html");
  CHECK(Json::parse(element_text(html, "trade-table")) == table);
  CHECK_THAT(html, !Contains("<b>") && !Contains("alert(1)</script>"));
  const Json images = Json::parse(element_text(html, "trade-images"));
  CHECK(images["images"].size() == 1 + 11 + 2);
  CHECK(images["left_out"].empty());
  CHECK(images["images"]["runs/0004.exr"]["width"] == fixture::width);
  CHECK(images["images"]["runs/0004.exr"]["reduction"] == 1);
  CHECK(images["images"]["runs/0004.tests.exr#tests"]["kind"] == "scalar");
  CHECK(images["images"]["runs/0011.exr"]["width"] == fixture::large_width / 2);
  CHECK(images["images"]["runs/0011.exr"]["height"] == fixture::large_height / 2);
  CHECK(images["images"]["runs/0011.exr"]["reduction"] == 2);
  for (const auto& [key, image] : images["images"].items())
    CHECK(element_text(html, image["element"]).size() > 20);
  // As many scripts are closed as opened: two of data, one for each image, the page's own.
  CHECK(occurrences(html, "<script") == 2 + 14 + 1);
  CHECK(occurrences(html, "</script>") == 2 + 14 + 1);
}

TEST_CASE("Text that is no UTF-8 and numbers that are none leave the table readable") {
  const Json value = {{"label", "a\xff</script>"}, {"time", std::nan("")}};
  const Json read = Json::parse(script_json(value));
  CHECK(read["label"] == "a\xef\xbf\xbd</script>");
  CHECK(read["time"].is_null());
  CHECK_THAT(script_json(value), !Contains("<"));
}

TEST_CASE("The built page needs nothing from elsewhere") {
  const std::string page(report_page_template());
  CHECK(occurrences(page, report_data_marker) == 1);
  CHECK_THAT(page,
             !Contains("src=") && !Contains("<link rel=\"stylesheet\"") && !Contains("@import"));
}

TEST_CASE("Images go in by importance: reference, default, Pareto front, the rest") {
  const Json runs = Json::array({
      {{"id", "1"}, {"settings", {{"hider", "bbox"}}}, {"pareto", false}, {"image", "rest"}},
      {{"id", "2"},
       {"settings", {{"hider", "tct"}}},
       {"pareto", true},
       {"image", "front"},
       {"heatmaps", {{"tests", "front.tests"}}}},
      {{"id", "3"},
       {"settings", {{"spp", "4"}}},
       {"pareto", true},
       {"image", "default"},
       {"heatmaps", {{"tests", "default.tests"}, {"extra", "default.extra"}}}},
      {{"id", "4"}, {"settings", {{"spp", "16"}}}, {"ok", false}, {"image", nullptr}},
  });
  const Json table = {{"reference", {{"file", "reference"}}}, {"runs", runs}};
  CHECK(keys_of(images_by_importance(table)) ==
        std::vector<std::string>{"reference", "default", "default.tests#tests",
                                 "default.extra#extra", "front", "front.tests#tests", "rest"});
  CHECK(images_by_importance(Json::object()).empty());
}

TEST_CASE("Images beyond the budget are left out and named") {
  fixture::TemporaryFolder folder;
  fixture::write(folder.path());
  const Embedding all = embed_images(fixture::table(), folder.path(), 100'000'000);
  REQUIRE(all.images.size() == 14);
  CHECK(all.left_out.empty());

  const size_t budget = all.images[0].encoded.text.size() + all.images[1].encoded.text.size();
  const Embedding some = embed_images(fixture::table(), folder.path(), budget);
  CHECK(keys_of(some.images) == std::vector<std::string>{"reference.exr", "runs/0001.exr"});
  CHECK(some.bytes == budget);
  CHECK(some.left_out.size() == 12);
  CHECK(embed_images(fixture::table(), folder.path(), budget - 1).images.front().key ==
        "reference.exr");

  write_report(fixture::table(), folder.path(), folder.path() / "page.html", budget);
  const Json images =
      Json::parse(element_text(content_of(folder.path() / "page.html"), "trade-images"));
  CHECK(images["left_out"].size() == 12);
  CHECK(images["left_out"][0]["what"] == "run 0002");
  CHECK(images["budget_bytes"] == budget);
}

TEST_CASE("A missing image is an error that names it, and the page stays as it was") {
  fixture::TemporaryFolder folder;
  fixture::write(folder.path());
  const std::filesystem::path page = folder.path() / "page.html";
  std::ofstream(page) << "before";
  std::filesystem::remove(folder.path() / "runs/0007.exr");
  const size_t files =
      size_t(std::distance(std::filesystem::directory_iterator(folder.path()), {}));
  // Also when there is no room for any image.
  for (const size_t budget : {default_report_image_bytes, size_t(0)})
    CHECK_THROWS_WITH(write_report(fixture::table(), folder.path(), page, budget),
                      Contains("0007.exr") && Contains("run 0007"));
  CHECK(content_of(page) == "before");
  CHECK(size_t(std::distance(std::filesystem::directory_iterator(folder.path()), {})) == files);
}

TEST_CASE("A page that cannot be written is an error") {
  fixture::TemporaryFolder folder;
  fixture::write(folder.path());
  const Json table = fixture::table();
  CHECK_THROWS_AS(write_report(table, folder.path(), folder.path() / "none/page.html"), Error);
  CHECK_THROWS_AS(write_report(table, folder.path(), folder.path() / "runs"), Error);
}

TEST_CASE(
    "An image without colours, or a map without its channel, is an error that names the file") {
  fixture::TemporaryFolder folder;
  fixture::write(folder.path());
  Image image(4, 4);
  image.add_channel("Z");
  write_exr((folder.path() / "runs/0004.tests.exr").string(), image);
  CHECK_THROWS_WITH(write_report(fixture::table(), folder.path(), folder.path() / "page.html"),
                    Contains("0004.tests.exr") && Contains("heatmap.tests"));
  write_exr((folder.path() / "runs/0002.exr").string(), image);
  CHECK_THROWS_WITH(write_report(fixture::table(), folder.path(), folder.path() / "page.html"),
                    Contains("0002.exr") && Contains("R, G and B"));
}

}  // namespace tessera
