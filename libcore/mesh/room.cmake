eikonal_room(mesh
    SOURCES triangle_mesh.cpp shells.cpp check.cpp intersections.cpp repair.cpp weld.cpp
            solid_boundary.cpp triangle_tree.cpp walls.cpp
            sheet.cpp plate.cpp curved_face.cpp nearest_of_four.cpp fans.cpp fit_normals.cpp smooth_surface.cpp
            read.cpp file_text.cpp formats.cpp parts.cpp
            read_obj.cpp read_off.cpp read_ply.cpp read_stl.cpp triangulate.cpp
            fill_loops.cpp write_obj.cpp
    LIBRARIES CGAL::CGAL OWN_FLAGS)
