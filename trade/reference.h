#pragma once
/// The image that errors are measured against.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "images/image.h"
#include "trade/linear_cost.h"
#include "trade/measurement.h"
#include "trade/renderer.h"

namespace tessera::trade {

struct Reference {
  std::string file;                  ///< an EXR
  int spp = 0;                       ///< of both halves together; 0: unknown
  double frame_s = unknown;          ///< of both halves
  double rel_mse = unknown;          ///< its own error, estimated
  std::vector<std::string> options;  ///< besides those of every run
  bool cached = false;               ///< found, not rendered now
};

struct ReferenceRequest {
  int spp = 1024;      ///< of both halves together
  std::string cache;   ///< folder of references; made when it is missing
  std::string folder;  ///< for files on the way
  std::string scene_hash;
  std::function<double()> left_s;               ///< seconds in which it has to be there
  std::function<void(const std::string&)> say;  ///< told what is being done
};

/// The options of a reference: those of the most accurate way that is sane, and not those that
/// every run is given anyway. Seeds are set apart from these.
std::vector<std::string> reference_options(const std::vector<std::string>& common);

/// Takes the reference from the cache, or renders it: the mean of two images of half the samples
/// each, with seeds of their own that no run has, so that its error is independent of theirs. The
/// halves' difference tells its variance: a and b with the same expectation have
/// E[(a - b)^2] / 4 = Var[(a + b) / 2]. That is its noise; a bias both share does not show. The
/// cache's key is made of the scene's hash, the options, the renderer's bytes and its version.
/// Throws Error when a render fails; the first half, if it is finished, is kept in the cache for
/// the next time.
Reference make_reference(const Renderer& renderer, const ReferenceRequest& request);

/// Whether make_reference() would find it in the cache.
bool is_cached(const Renderer& renderer, const ReferenceRequest& request);

/// Seconds that a reference of `spp` samples for both halves together takes, from one or two short
/// renders with its options, by rising samples.
double predict_reference_s(const std::vector<Pilot>& pilots, int spp);

/// The reference of a sweep that goes on: `file`, if it is there and its pixels have the hash
/// `expected_hash`.
std::optional<Reference> kept_reference(const Renderer& renderer, const std::string& file,
                                        const std::string& expected_hash);

/// Takes a given image. Throws Error when it is not of this scene: another size or crop than
/// `probe`, an image of the default; another scene hash, where it was made here; another scene
/// file, camera or shutter, where its metadata say.
Reference take_reference(const std::string& file, const std::string& probe,
                         const std::string& scene_hash);

/// Mean of two images of the same windows and channels, and the relMSE of the mean's noise, over
/// R, G and B.
struct MeanOfTwo {
  Image image;
  double rel_mse = 0;
};
MeanOfTwo mean_of_two(const Image& a, const Image& b);

}  // namespace tessera::trade
