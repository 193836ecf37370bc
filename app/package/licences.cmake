# Part of the installation of the bundle: copies the licences of the Debian packages that it contains, and writes which
# ones these are. dpkg_query: the program.
set(folder "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}")
set(licences "${folder}/share/doc/sbcollide/licences")
make_open_folder(share/doc/sbcollide/licences)
# Their headers and static libraries are parts of the program.
set(packages fonts-inter libcli11-dev libeigen3-dev libglm-dev libimgui-dev nlohmann-json3-dev)
file(GLOB libraries RELATIVE "${folder}/lib" "${folder}/lib/*.so*")
foreach(library IN LISTS libraries)
  execute_process(COMMAND ${dpkg_query} --search "*/${library}" OUTPUT_VARIABLE owner COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCH "^[^:]+" owner "${owner}")
  list(APPEND packages ${owner})
endforeach()
list(REMOVE_DUPLICATES packages)
foreach(package IN LISTS packages)
  configure_file(/usr/share/doc/${package}/copyright "${licences}/${package}" COPYONLY)
  # Texts that several packages have in common.
  file(STRINGS /usr/share/doc/${package}/copyright lines REGEX "/usr/share/common-licenses/")
  string(REGEX MATCHALL "common-licenses/[A-Za-z0-9.-]*[A-Za-z0-9]" texts "${lines}")
  foreach(text IN LISTS texts)
    get_filename_component(name ${text} NAME)
    configure_file(/usr/share/${text} "${licences}/${name}" COPYONLY)
  endforeach()
endforeach()
execute_process(
  COMMAND ${dpkg_query} --show "--showformat=\${Package} \${Version}, source \${source:Package} \${source:Version}\n"
    ${packages}
  OUTPUT_VARIABLE versions COMMAND_ERROR_IS_FATAL ANY)
file(WRITE "${licences}/README"
  "The libraries and the font come unchanged from these packages. https://snapshot.debian.org has their sources.\n
${versions}")
file(CHMOD "${licences}/README" PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
