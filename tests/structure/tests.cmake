# What holds for the source tree itself.
add_test(NAME rooms COMMAND bash ${CMAKE_CURRENT_LIST_DIR}/check_rooms.sh ${PROJECT_SOURCE_DIR})
add_test(NAME shader_docs COMMAND bash ${PROJECT_SOURCE_DIR}/pipelines/shader_docs.sh
                                  ${PROJECT_SOURCE_DIR}/shaders --check)
