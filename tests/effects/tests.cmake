# The price list of effects: `effects` measures it, test_effects holds what needs no clock.
add_library(effects_parts STATIC effects/tokens.cpp effects/fold.cpp effects/prune.cpp
            effects/cut.cpp effects/cuts.cpp effects/sharp_cuts.cpp effects/variant.cpp
            effects/cases.cpp)
target_link_libraries(effects_parts PUBLIC libcore)
target_include_directories(effects_parts SYSTEM PUBLIC ${JSON_INCLUDE})

eikonal_test(test_effects SOURCES effects/effects_test.cpp LIBRARIES effects_parts)

add_executable(effects effects/main.cpp effects/measure.cpp effects/page.cpp)
target_link_libraries(effects PRIVATE effects_parts)
target_include_directories(effects SYSTEM PRIVATE ${CLI11_INCLUDE})
set_target_properties(effects PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
