eikonal_test(test_sim2vol SOURCES sim2vol/laws_test.cpp sim2vol/plume_test.cpp LIBRARIES test_support)

eikonal_manners(sim2vol_manners sim2vol/sim2vol_test.sh)
