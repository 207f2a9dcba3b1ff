# What holds for the source tree itself.
eikonal_run(rooms COMMAND bash ${CMAKE_CURRENT_LIST_DIR}/check_rooms.sh ${PROJECT_SOURCE_DIR})
eikonal_run(shader_docs COMMAND bash ${PROJECT_SOURCE_DIR}/pipelines/shader_docs.sh
                                ${PROJECT_SOURCE_DIR}/shaders --check)
