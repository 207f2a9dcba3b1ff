# The benchmark is no test: it times, and asserts nothing.
eikonal_program(bench SOURCES bench/main.cpp bench/kernels.cpp bench/sharp.cpp
                              bench/stages.cpp bench/scenes.cpp bench/steps.cpp bench/floors.cpp bench/fronts.cpp bench/surfaces.cpp
                              bench/hierarchy.cpp bench/image_space.cpp
                      LIBRARIES test_support)
# Look-ups beside NanoVDB's, where its headers are at hand (Debian: libnanovdb-dev).
find_file(NANOVDB_HEADER nanovdb/PNanoVDB.h)
if(NANOVDB_HEADER)
    target_sources(bench PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/bench/sparse.cpp)
    target_compile_definitions(bench PRIVATE EIKONAL_SOURCE_DIR="${PROJECT_SOURCE_DIR}" EIKONAL_NANOVDB_HEADER="${NANOVDB_HEADER}")
endif()
