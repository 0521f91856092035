#pragma once
/// Which files a rendered frame becomes.

#include <string>
#include <string_view>
#include <vector>

#include "engine/frame.h"
#include "engine/frame_files.h"

namespace tessera {

/// Throws Error when one of a frame's files has a name of no format, or its Display a mode that is
/// none. Called before rendering.
void check_formats(const FrameFiles& files, const Scene& scene);

/// Writes every channel of the frame to `path` (EXR through a temporary name; other extensions
/// through the image module).
void write_frame(const FrameResult& frame, const std::string& path);

/// The files that a frame will be written to when no output is named: those of the scene's
/// Displays (framebuffer displays excepted), or SCENE.exr. Relative to the working directory.
std::vector<std::string> display_outputs(const Scene& scene);

/// Writes the frame to display_outputs(), each with the channels its Display asks for. Returns
/// the names written.
std::vector<std::string> write_displays(const FrameResult& frame, const Scene& scene);

/// Writes the depth file `picture` again as shadow map `shadow`, through a temporary name. Throws
/// Error when it cannot be read or lacks what a shadow map needs (shade/shadow_map.h).
void make_shadow(const std::string& picture, const std::string& shadow);

/// An 8-bit picture to look at, from the rgb channels; sRGB unless the scene's own Exposure encodes
/// it.
void write_preview(const FrameResult& frame, const std::string& path);

/// Where the picture of heat map `name` goes: OUT.exr -> OUT.NAME.png.
std::string heatmap_path(const std::string& image, std::string_view name);

/// The frame's heat map in false colours (engine/heatmap.h).
void write_heatmap(const FrameResult& frame, const std::string& path);

}  // namespace tessera
