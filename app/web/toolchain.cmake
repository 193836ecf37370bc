# For the preset `web`: emscripten of Debian 13, and the libraries that libraries.sh has built.
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)
list(APPEND CMAKE_FIND_ROOT_PATH /libraries)
set(CMAKE_FIND_PACKAGE_PREFER_CONFIG ON)
set(CMAKE_C_FLAGS_INIT "-msimd128 -fwasm-exceptions")
set(CMAKE_CXX_FLAGS_INIT "${CMAKE_C_FLAGS_INIT} -fexperimental-library -isystem ${CMAKE_CURRENT_LIST_DIR}/include -include ${CMAKE_CURRENT_LIST_DIR}/from_chars.h")
