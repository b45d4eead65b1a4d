# `cpack --config build/release/CPackConfig.cmake`: surimi_*.deb, the program, and libsurimi-dev_*.deb, the runtime.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME surimi)
set(CPACK_PACKAGE_VENDOR Surimi)
set(CPACK_PACKAGE_CONTACT "The Surimi authors <authors@surimi.invalid>")
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME surimi)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "Baker of visibility maps for monitor light
 Computes for every lightmap texel which share of the light of up to three
 monitors arrives, from glTF, within an error that is promised and proved.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libsurimi-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
# What the installed CMake package looks for.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libembree-dev, libopenimageio-dev, libglm-dev, libtbb-dev, libfmt-dev, libdraco-dev, libmeshoptimizer-dev, libhwy-dev, libtinygltf-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Runtime of Surimi, which shows what it baked
 Headers and a static library: glTF scenes, visibility maps, linearly
 transformed cosines, a preview on the CPU.")
include(CPack)
