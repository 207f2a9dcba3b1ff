# The price list of accuracy is no test: it measures, and asserts nothing.
eikonal_program(accuracy
    SOURCES accuracy/main.cpp accuracy/rows.cpp accuracy/fields.cpp accuracy/rays.cpp
            accuracy/orders.cpp accuracy/ball.cpp accuracy/chain.cpp accuracy/sharp.cpp
            accuracy/glass.cpp accuracy/light.cpp accuracy/light_truth.cpp accuracy/summary.cpp
            accuracy/report.cpp accuracy/sharp_report.cpp accuracy/page.cpp accuracy/tables.cpp accuracy/image_space.cpp accuracy/image_report.cpp
    LIBRARIES test_support)
# Rows measured with another library are measured again.
target_compile_definitions(accuracy PRIVATE EIKONAL_LIBRARY="$<TARGET_FILE:libcore>")
