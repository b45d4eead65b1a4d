# Libraries without a usable CMake package, as targets: for the build, and for who uses the installed runtime. Lists what
# is not there in surimi_missing.
find_path(SURIMI_GLM glm/glm.hpp)
# Debian's OpenImageIO config names folders of packages that need not be installed (OpenCV, PyImath).
find_library(SURIMI_OPENIMAGEIO OpenImageIO)
find_library(SURIMI_OPENIMAGEIO_UTIL OpenImageIO_Util)
find_library(SURIMI_HIGHWAY hwy)
mark_as_advanced(SURIMI_GLM SURIMI_OPENIMAGEIO SURIMI_OPENIMAGEIO_UTIL SURIMI_HIGHWAY)

set(surimi_missing)
foreach(library SURIMI_GLM SURIMI_OPENIMAGEIO SURIMI_OPENIMAGEIO_UTIL SURIMI_HIGHWAY)
  if(NOT ${library})
    list(APPEND surimi_missing ${library})
  endif()
endforeach()

if(NOT surimi_missing AND NOT TARGET surimi::glm)
  add_library(surimi::glm INTERFACE IMPORTED)
  target_include_directories(surimi::glm INTERFACE ${SURIMI_GLM})
  add_library(surimi::openimageio INTERFACE IMPORTED)
  target_link_libraries(surimi::openimageio INTERFACE ${SURIMI_OPENIMAGEIO} ${SURIMI_OPENIMAGEIO_UTIL})
  add_library(surimi::highway INTERFACE IMPORTED)
  target_link_libraries(surimi::highway INTERFACE ${SURIMI_HIGHWAY})
endif()
