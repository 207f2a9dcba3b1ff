# A reference in double precision, which shares no code with libcore or the shaders: that is why
# its own test links neither.
add_library(judge STATIC judge/media.cpp judge/texels.cpp judge/caustic.cpp judge/water.cpp
                         judge/floor_view.cpp judge/trace.cpp judge/closed.cpp judge/snell.cpp
                         judge/photons.cpp judge/glass.cpp judge/glass_photons.cpp
                         judge/revolved.cpp judge/crystal.cpp judge/varying_crystal.cpp)
target_include_directories(judge PUBLIC ${CMAKE_CURRENT_SOURCE_DIR})
target_include_directories(judge SYSTEM PUBLIC ${GLM_INCLUDE})
target_link_libraries(judge PUBLIC Threads::Threads)
# It traces thousands of rays in double.
target_compile_options(judge PRIVATE $<$<CONFIG:Release>:-O2>)

add_executable(test_judge judge/trace_test.cpp judge/snell_test.cpp judge/glass_test.cpp
                          judge/revolved_test.cpp judge/light_test.cpp
                          judge/crystal_test.cpp)
target_link_libraries(test_judge PRIVATE judge GTest::gtest_main)
target_precompile_headers(test_judge REUSE_FROM test_headers)
eikonal_run(test_judge COMMAND test_judge --gtest_filter=-Fluence.*:Beams.*)
eikonal_run(test_judge_long LONG COMMAND test_judge --gtest_filter=Fluence.*:Beams.*)
