# What holds for the source tree itself.
eikonal_run(rooms COMMAND bash ${CMAKE_CURRENT_LIST_DIR}/check_rooms.sh ${PROJECT_SOURCE_DIR})
