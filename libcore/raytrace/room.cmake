eikonal_room(raytrace SOURCES dielectric.cpp faces.cpp normal_distances.cpp params.cpp paths.cpp picture.cpp
                              raytrace.cpp surface.cpp
             LIBRARIES embree SYSTEM_INCLUDES ${PROJECT_SOURCE_DIR}/shaders)
