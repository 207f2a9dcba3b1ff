eikonal_run(pipeline LONG COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/pipeline/pipe_test.sh
                               ${CMAKE_BINARY_DIR})

# Renders the golden pictures anew, to be looked at.
add_custom_target(update_golden
    COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/pipeline/update_golden.sh ${CMAKE_BINARY_DIR}
    DEPENDS mesh2vol volsmooth lightsim render VERBATIM)
