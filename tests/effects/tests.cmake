# The price list of effects: `effects` measures it, test_effects holds what needs no clock.
add_library(effects_parts STATIC effects/bindings.cpp effects/cases.cpp effects/counts.cpp
            effects/spirv.cpp effects/variant.cpp)
target_link_libraries(effects_parts PUBLIC libcore)
target_include_directories(effects_parts SYSTEM PRIVATE ${PROJECT_SOURCE_DIR}/shaders)

eikonal_test(test_effects SOURCES effects/effects_test.cpp LIBRARIES effects_parts LONG "*")

eikonal_program(effects SOURCES effects/main.cpp effects/measure.cpp effects/page.cpp
                LIBRARIES effects_parts)
