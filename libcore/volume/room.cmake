eikonal_room(volume SOURCES contract.cpp level_set.cpp objects.cpp vdb_frame.cpp vdb_stream.cpp
                            volume.cpp
             SYSTEM_INCLUDES ${OPENVDB_INCLUDE} LIBRARIES Imath::Imath)
