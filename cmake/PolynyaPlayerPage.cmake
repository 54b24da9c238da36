# The player's page (views/player) as a C++ source: its style sheets and scripts are put into its HTML, and that into
# one constant, when one of them changes. Building needs nothing but CMake.
#
#   polynya_player_page(FOLDER OUTPUT)
#
# As a script, `cmake -DFOLDER=… -DOUTPUT=… -P PolynyaPlayerPage.cmake` writes OUTPUT.

# In the order they stand in the page.
set(POLYNYA_PLAYER_STYLES vendor/uPlot.min.css player.css)
set(POLYNYA_PLAYER_SCRIPTS numbers.js floe_shapes.js run_data.js motion.js breakage.js palette.js map_view.js floe_raster.js draw_ice.js still_ice.js
  under_hull.js floe_card.js shown_floe.js channel.js contact_forces.js contact_circles.js draw_marks.js draw_ship.js legend.js map_picture.js
  plot_scale.js plot_curves.js plot_reading.js plot_off_scale.js plot_chart.js plot_gestures.js plot.js plot_panel.js timeline.js gestures.js keyboard.js page.js
  actions.js draw_loop.js player.js)

function(polynya_player_page folder output)
  set(parts ${POLYNYA_PLAYER_STYLES} ${POLYNYA_PLAYER_SCRIPTS} player.html vendor/uPlot.iife.min.js vendor/uPlot-LICENSE)
  list(TRANSFORM parts PREPEND ${folder}/)
  set(script ${CMAKE_CURRENT_FUNCTION_LIST_FILE})
  add_custom_command(OUTPUT ${output} DEPENDS ${parts} ${script} VERBATIM
    COMMAND ${CMAKE_COMMAND} -DFOLDER=${folder} -DOUTPUT=${output} -P ${script})
endfunction()

if(CMAKE_SCRIPT_MODE_FILE)
  function(join_files variable)
    set(all "")
    foreach(name IN LISTS ARGN)
      file(READ ${FOLDER}/${name} text)
      string(APPEND all "${text}")
    endforeach()
    set(${variable} "${all}" PARENT_SCOPE)
  endfunction()
  join_files(page player.html)
  join_files(styles ${POLYNYA_PLAYER_STYLES})
  join_files(plot vendor/uPlot.iife.min.js)
  join_files(licence vendor/uPlot-LICENSE)
  string(PREPEND plot "/*! uPlot:\n${licence}*/\n")
  join_files(scripts ${POLYNYA_PLAYER_SCRIPTS})
  string(REPLACE "/*{{styles}}*/" "${styles}" page "${page}")
  string(REPLACE "/*{{plot}}*/" "${plot}" page "${page}")
  string(REPLACE "/*{{scripts}}*/" "${scripts}" page "${page}")
  file(WRITE ${OUTPUT} "#include \"views/player/player_page.hpp\"\n\nnamespace polynya::views {\n\n"
    "const std::string_view kPlayerTemplate = R\"player~(${page})player~\";\n\n}  // namespace polynya::views\n")
endif()
