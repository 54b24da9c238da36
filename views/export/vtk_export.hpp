#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "io/run/motion_index.hpp"
#include "io/run/run_reader.hpp"

namespace polynya::views {

struct VtkExport {
  std::size_t frames = 0;
  std::vector<simulation::FloeId> only_outlines;  ///< floes of a damaged run whose rings bound no area
};

/// Writes a run for ParaView (docs/export.md): run.pvd, and for each selected frame the ice, the ships, their
/// loads and the contacts. The error names the file.
tl::expected<VtkExport, std::string> export_vtk(const io::Run& run, const io::FrameSelection& selection,
                                                const std::filesystem::path& folder);

}  // namespace polynya::views
