eikonal_run(gallery LONG COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/gallery/gallery_test.sh ${CMAKE_BINARY_DIR})
