# Finds GMP and its C++ interface by the names of their files, as not every system has them in pkg-config. Makes the
# target GMP::gmpxx.
find_path(GMPXX_INCLUDE_DIR gmpxx.h)
find_file(GMP_HEADER gmp.h)
find_library(GMPXX_LIBRARY gmpxx)
find_library(GMP_LIBRARY gmp)
mark_as_advanced(GMPXX_INCLUDE_DIR GMP_HEADER GMPXX_LIBRARY GMP_LIBRARY)
if(GMP_HEADER)
  file(STRINGS ${GMP_HEADER} parts REGEX "^#define __GNU_MP_VERSION[A-Z_]* +[0-9]+")
  string(REGEX REPLACE "#define [A-Z_]+ +" "" parts "${parts}")
  string(REPLACE ";" "." GMPXX_VERSION "${parts}")
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(GMPXX REQUIRED_VARS GMPXX_LIBRARY GMP_LIBRARY GMPXX_INCLUDE_DIR
  VERSION_VAR GMPXX_VERSION)
if(GMPXX_FOUND AND NOT TARGET GMP::gmpxx)
  add_library(GMP::gmpxx UNKNOWN IMPORTED)
  set_target_properties(GMP::gmpxx PROPERTIES IMPORTED_LOCATION "${GMPXX_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${GMPXX_INCLUDE_DIR}" INTERFACE_LINK_LIBRARIES "${GMP_LIBRARY}")
endif()
