eikonal_room(smooth SOURCES kernel.cpp params.cpp plan.cpp sides.cpp smooth.cpp
             SYSTEM_INCLUDES ${PROJECT_SOURCE_DIR}/shaders)
