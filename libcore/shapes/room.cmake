eikonal_room(shapes SOURCES bodies.cpp curves.cpp flecks.cpp implicit.cpp logo.cpp outline_checks.cpp profile.cpp
                            revolve.cpp solids.cpp brilliant.cpp svg.cpp wave.cpp
             LIBRARIES PkgConfig::FREETYPE)
