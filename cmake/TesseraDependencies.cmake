# Every third-party package, as an imported target. All come from Debian 12.
find_package(PkgConfig REQUIRED)
find_package(fmt REQUIRED)
find_package(glm REQUIRED)
find_package(TBB REQUIRED)
find_package(ZLIB REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
pkg_check_modules(HWY REQUIRED IMPORTED_TARGET libhwy)
add_library(hwy ALIAS PkgConfig::HWY)

# Through pkg-config: the CMake package of Imath, which OpenEXR's pulls in, warns about a Python
# binding that Debian packages apart.
pkg_check_modules(OPENEXR REQUIRED IMPORTED_TARGET OpenEXR)
add_library(OpenEXR::OpenEXR ALIAS PkgConfig::OPENEXR)

# OpenImageIO's own CMake target names a missing OpenCV include folder; pkg-config does not.
pkg_check_modules(OIIO REQUIRED IMPORTED_TARGET OpenImageIO)

# OpenSubdiv's CMake package names static libraries that Debian does not ship.
find_library(OSD_CPU_LIBRARY osdCPU REQUIRED)
find_path(OSD_INCLUDE_DIR opensubdiv/bfr/surface.h REQUIRED)
add_library(OSD::osd SHARED IMPORTED)
set_target_properties(OSD::osd PROPERTIES IMPORTED_LOCATION ${OSD_CPU_LIBRARY}
                                          INTERFACE_INCLUDE_DIRECTORIES ${OSD_INCLUDE_DIR})

# Embree answers rays, serves as an oracle in the tests and as the peer in the benchmarks.
find_library(EMBREE_LIBRARY embree3 REQUIRED)
find_path(EMBREE_INCLUDE_DIR embree3/rtcore.h REQUIRED)
add_library(Embree::embree SHARED IMPORTED)
set_target_properties(Embree::embree PROPERTIES IMPORTED_LOCATION ${EMBREE_LIBRARY}
                                                INTERFACE_INCLUDE_DIRECTORIES ${EMBREE_INCLUDE_DIR})
