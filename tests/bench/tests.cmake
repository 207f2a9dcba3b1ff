# The benchmark is no test: it times, and asserts nothing.
add_executable(bench bench/main.cpp bench/kernels.cpp bench/sharp.cpp
               bench/stages.cpp bench/scenes.cpp bench/steps.cpp)
target_link_libraries(bench PRIVATE libcore)
target_include_directories(bench SYSTEM PRIVATE ${CLI11_INCLUDE} ${JSON_INCLUDE})
set_target_properties(bench PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
