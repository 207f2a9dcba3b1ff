eikonal_room(scenefile
    SOURCES gltf.cpp gltf_accessors.cpp gltf_materials.cpp gltf_model.cpp gltf_primitives.cpp mtl.cpp
    SYSTEM_INCLUDES ${TINYGLTF_INCLUDE} ${JSON_INCLUDE})
