# The price list of accuracy is no test: it measures, and asserts nothing.
add_executable(accuracy accuracy/main.cpp accuracy/rows.cpp accuracy/fields.cpp accuracy/rays.cpp
               accuracy/orders.cpp accuracy/ball.cpp accuracy/chain.cpp accuracy/sharp.cpp
               accuracy/glass.cpp accuracy/light.cpp accuracy/light_truth.cpp accuracy/summary.cpp
               accuracy/report.cpp accuracy/sharp_report.cpp accuracy/page.cpp accuracy/tables.cpp
               sharp/glass_volume.cpp)
target_link_libraries(accuracy PRIVATE libcore judge GTest::gtest) # which glass_volume.h reports to
target_include_directories(accuracy SYSTEM PRIVATE ${CLI11_INCLUDE} ${JSON_INCLUDE})
# Rows measured with another library are measured again.
target_compile_definitions(accuracy PRIVATE EIKONAL_LIBRARY="$<TARGET_FILE:libcore>")
set_target_properties(accuracy PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
