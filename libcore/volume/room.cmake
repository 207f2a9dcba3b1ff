eikonal_room(volume SOURCES bricks.cpp contract.cpp derive.cpp entries.cpp fine_grid.cpp ground.cpp level_set.cpp objects.cpp polygonize.cpp put.cpp
                            vdb_bytes.cpp vdb_check.cpp vdb_file.cpp vdb_frame.cpp vdb_tree.cpp
                            vdb_write.cpp volume.cpp
             SYSTEM_INCLUDES ${OPENVDB_INCLUDE} LIBRARIES Imath::Imath)
