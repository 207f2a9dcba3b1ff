# The shaders travel inside the library, so that a tool is one file.
set(shader_folder ${PROJECT_SOURCE_DIR}/shaders)
set(shader_table ${CMAKE_CURRENT_BINARY_DIR}/embedded_shaders.cpp)
file(GLOB_RECURSE shader_files CONFIGURE_DEPENDS ${shader_folder}/*.glsl ${shader_folder}/*.h)
add_custom_command(OUTPUT ${shader_table}
    COMMAND ${CMAKE_COMMAND} -DFOLDER=${shader_folder} -DOUTPUT=${shader_table}
            -P ${PROJECT_SOURCE_DIR}/cmake/embed_shaders.cmake
    DEPENDS ${shader_files} ${PROJECT_SOURCE_DIR}/cmake/embed_shaders.cmake VERBATIM)

eikonal_room(gpu SOURCES device.cpp program.cpp raster.cpp resources.cpp
             LIBRARIES PkgConfig::EPOXY PkgConfig::EGL)
target_sources(room_gpu PRIVATE ${shader_table})
