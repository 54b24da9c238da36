#pragma once

#include <filesystem>
#include <string>

#include <tl/expected.hpp>

#include "io/run_reader.hpp"
#include "io/thinned_frames.hpp"

namespace polynya::io {

/// Writes a run for ParaView (docs/export.md): run.pvd, and for each selected frame the ice, the ships, their
/// loads and the contacts. Returns how many frames, or what went wrong.
tl::expected<std::size_t, std::string> export_vtk(const Run& run, const FrameSelection& selection,
                                                  const std::filesystem::path& folder);

}  // namespace polynya::io
