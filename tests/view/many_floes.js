// Prints a scene with 10 000 floes of 15 m and an icebreaker through them, for measuring the player:
//   node tests/view/many_floes.js > /tmp/many.json && polynya run /tmp/many.json --out /tmp/many
"use strict";
console.log(JSON.stringify({
  name: "ten-thousand-floes",
  description: "125 x 80 floes of 15 m, 18 m apart",
  time: { step_s: 0.01, until_s: 400 },
  ships: [{
    name: "icebreaker",
    hull: { length_m: 120, beam_m: 24, entrance_angle_deg: 27, stem_angle_deg: 30 },
    mass_kg: 1e7, moment_of_inertia_kg_m2: 5e9, position_m: [-60, 718], heading_deg: 0,
    propulsion: { constant_speed_m_per_s: 3 },
  }],
  floes: [{ lattice: { origin_m: [0, 0], columns: 125, rows: 80, pitch_m: 18, size_m: 15 } }],
}, null, 2));
