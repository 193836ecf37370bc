# The preset `bundle`: one tar.gz for any Linux that has the C library of who makes it, or a newer one. It carries the
# libraries of the program, but not those that belong to the system: of C, C++, zlib, OpenGL, X and Wayland, which its
# drivers use, too. What the program reads stands beside it, the font included.
find_file(SBCOLLIDE_FONT Inter-Regular.otf PATHS /usr/share/fonts/opentype PATH_SUFFIXES inter REQUIRED
  DOC "The font that the bundle carries")
find_program(DPKG_QUERY dpkg-query REQUIRED)
mark_as_advanced(SBCOLLIDE_FONT DPKG_QUERY)

# DT_RPATH, not DT_RUNPATH: the libraries find each other by it, too.
target_link_options(sbcollide PRIVATE -Wl,--disable-new-dtags)
set_target_properties(sbcollide PROPERTIES INSTALL_RPATH $ORIGIN/../lib)
place(runtime bin TARGETS sbcollide RUNTIME_DEPENDENCY_SET bundled RUNTIME)
open_folder(runtime lib)
install(RUNTIME_DEPENDENCY_SET bundled
  PRE_EXCLUDE_REGEXES "^ld-linux" "^lib(c|m|dl|pthread|rt|stdc\\+\\+|gcc_s|z)\\.so"
    "^lib(GL|OpenGL|GLX|GLdispatch|EGL|X[^.]*|xcb[^.]*|wayland[^.]*)\\.so"
  LIBRARY DESTINATION lib COMPONENT runtime)
place(runtime ${data}/sbcollide/assets/fonts FILES ${SBCOLLIDE_FONT})
place(runtime ${data}/doc/sbcollide FILES ${PROJECT_SOURCE_DIR}/LICENSE)
install(CODE "set(dpkg_query ${DPKG_QUERY})" COMPONENT runtime)
install(SCRIPT licences.cmake COMPONENT runtime)

set(CPACK_GENERATOR TGZ)
string(TOLOWER sbcollide-${PROJECT_VERSION}-${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR} CPACK_PACKAGE_FILE_NAME)
