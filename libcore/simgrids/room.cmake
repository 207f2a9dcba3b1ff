eikonal_room(simgrids SOURCES map.cpp simgrids.cpp)
