eikonal_room(view SOURCES camera.cpp params.cpp plan.cpp plan_sharp.cpp scene.cpp view.cpp
             SYSTEM_INCLUDES ${PROJECT_SOURCE_DIR}/shaders)
