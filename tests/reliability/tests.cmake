# Refusals of the system, by a library that stands before the system's functions.
add_library(refuse MODULE reliability/refuse.cpp)
target_link_libraries(refuse PRIVATE ${CMAKE_DL_LIBS})
eikonal_run(refusals LONG COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/reliability/refusal_test.sh
                             ${CMAKE_BINARY_DIR} $<TARGET_FILE:refuse>)
