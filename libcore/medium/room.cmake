eikonal_room(medium SOURCES medium.cpp field.cpp samples.cpp objects.cpp regions.cpp surfaces.cpp SYSTEM_INCLUDES ${PROJECT_SOURCE_DIR}/shaders)
set_source_files_properties(${CMAKE_CURRENT_SOURCE_DIR}/medium/samples.cpp PROPERTIES COMPILE_OPTIONS -O3
                            SKIP_PRECOMPILE_HEADERS ON)
