# The player's pages (views/player), of one run and of two, as a C++ source: style sheets and scripts are inserted into
# their HTML, and each HTML page becomes a constant. This happens when one of the files changes. Building needs only
# CMake.
#
#   polynya_player_page(FOLDER OUTPUT)
#
# The page of one run is also written as OUTPUT.html, for the page that holds the simulator (browser/page/join.py).
#
# Called as a script, `cmake -DFOLDER=… -DOUTPUT=… -P PolynyaPlayerPage.cmake` writes OUTPUT.

# The files are listed in the order in which the page contains them.
set(POLYNYA_PLAYER_STYLES vendor/uPlot.min.css player.css)
set(POLYNYA_PLAYER_SCRIPTS numbers.js clock.js run_data.js motion.js map_view.js colours.js sizes.js draw_ice.js
  channel.js draw_marks.js ship_names.js ruler.js load_line.js floe_card.js ship_card.js plot_curves.js plot.js
  plot_panel.js timeline.js input.js moment_link.js save_picture.js plan.js actions.js player.js)
set(POLYNYA_PAIR_SCRIPTS numbers.js clock.js input.js moment_link.js pair.js)

function(polynya_player_page folder output)
  set(parts ${POLYNYA_PLAYER_STYLES} ${POLYNYA_PLAYER_SCRIPTS} ${POLYNYA_PAIR_SCRIPTS} player.html pair.html tools.html
    pair.css vendor/uPlot.iife.min.js vendor/uPlot-LICENSE)
  list(TRANSFORM parts PREPEND ${folder}/)
  set(script ${CMAKE_CURRENT_FUNCTION_LIST_FILE})
  add_custom_command(OUTPUT ${output} ${output}.html DEPENDS ${parts} ${script} VERBATIM
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
  join_files(tools tools.html)
  join_files(page player.html)
  join_files(styles ${POLYNYA_PLAYER_STYLES})
  join_files(plot vendor/uPlot.iife.min.js)
  join_files(licence vendor/uPlot-LICENSE)
  string(PREPEND plot "/*! uPlot:\n${licence}*/\n")
  join_files(scripts ${POLYNYA_PLAYER_SCRIPTS})
  string(REPLACE "<!--{{tools}}-->\n" "${tools}" page "${page}")
  string(REPLACE "/*{{styles}}*/" "${styles}" page "${page}")
  string(REPLACE "/*{{plot}}*/" "${plot}" page "${page}")
  string(REPLACE "/*{{scripts}}*/" "${scripts}" page "${page}")
  file(WRITE ${OUTPUT}.html "${page}")
  join_files(pair pair.html)
  join_files(pair_styles player.css pair.css)
  join_files(pair_scripts ${POLYNYA_PAIR_SCRIPTS})
  string(REPLACE "<!--{{tools}}-->\n" "${tools}" pair "${pair}")
  string(REPLACE "/*{{styles}}*/" "${pair_styles}" pair "${pair}")
  string(REPLACE "/*{{scripts}}*/" "${pair_scripts}" pair "${pair}")
  file(WRITE ${OUTPUT} "#include \"views/player/player_page.hpp\"\n\nnamespace polynya::views {\n\n"
    "const std::string_view kPlayerTemplate = R\"player~(${page})player~\";\n\n"
    "const std::string_view kPairTemplate = R\"player~(${pair})player~\";\n\n}  // namespace polynya::views\n")
endif()
