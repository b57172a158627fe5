# The one place that names external packages. Included by the build and, installed, by find_package(orbslam).
# What each is for, and why it and no other: Thirdparty/README.md.
include(CMakeFindDependencyMacro)
set(THREADS_PREFER_PTHREAD_FLAG ON)
find_dependency(Threads)
find_dependency(OpenCV 4.6 COMPONENTS core imgproc features2d calib3d)
find_dependency(Eigen3 3.4)
find_dependency(Ceres 2.1)
find_dependency(spdlog)
find_dependency(yaml-cpp)
find_dependency(nlohmann_json)
find_dependency(PkgConfig)
pkg_check_modules(spng REQUIRED IMPORTED_TARGET spng)
pkg_check_modules(turbojpeg REQUIRED IMPORTED_TARGET libturbojpeg)
pkg_check_modules(osmesa REQUIRED IMPORTED_TARGET osmesa)
# Of PCL the first library and the headers; modules name the others one by one (pcl_segmentation ...): PCL's own
# package file, and pkg-config's entries for those, drag in VTK, Qt, HDF5 and MPI.
pkg_check_modules(pcl REQUIRED IMPORTED_TARGET pcl_common)
