eikonal_room(image
    SOURCES exr_reader.cpp exr_workers.cpp exr_writer.cpp halves.cpp image.cpp input.cpp lat_long.cpp
            picture.cpp picture_module.cpp radiance.cpp
    LIBRARIES OpenEXR::OpenEXR)

# OpenImageIO brings some 250 libraries along; the module keeps them out of every process that
# meets no picture but EXR. Found without its CMake package, which asks for what only it needs.
find_path(OIIO_INCLUDE OpenImageIO/imageio.h REQUIRED)
find_library(OIIO_LIBRARY OpenImageIO REQUIRED)
find_library(OIIO_UTIL_LIBRARY OpenImageIO_Util REQUIRED)
add_library(eikonal_oiio MODULE ${CMAKE_CURRENT_SOURCE_DIR}/image/oiio_module.cpp)
target_include_directories(eikonal_oiio PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
target_include_directories(eikonal_oiio SYSTEM PRIVATE ${OIIO_INCLUDE})
target_link_libraries(eikonal_oiio PRIVATE ${OIIO_LIBRARY} ${OIIO_UTIL_LIBRARY} OpenEXR::OpenEXR)
set_target_properties(eikonal_oiio PROPERTIES
    CXX_VISIBILITY_PRESET hidden LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib/eikonal)
# Beside bin/: where picture_module.cpp looks.
install(TARGETS eikonal_oiio LIBRARY DESTINATION lib/eikonal)
