# find_package(orbslam) then link orbslam::orbslam, or one module such as orbslam::features.
include(${CMAKE_CURRENT_LIST_DIR}/dependencies.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/orbslamTargets.cmake)
