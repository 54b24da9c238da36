#pragma once

namespace polynya::tests {

/// A ship that breaks cusps from a plate within a second.
inline constexpr auto kTinyScene =
    R"({"name": "tiny", "time": {"step_s": 0.01, "until_s": 1}, "record": {"frames_interval_s": 0.5},
        "ships": [{"hull": {"length_m": 60, "beam_m": 16, "entrance_angle_deg": 30}, "mass_kg": 3e6,
          "moment_of_inertia_kg_m2": 8e8, "position_m": [-31, 0], "propulsion": {"constant_speed_m_per_s": 2}}],
        "floes": [{"rectangle": {"corner_m": [0.5, -40], "size_m": [120, 80]}}]})";

}  // namespace polynya::tests
