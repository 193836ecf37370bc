# Puts links to the folders that the program reads beside the programs that are built, where it looks first. They are
# relative, so that a checkout that is moved with its build folder takes them with it.
file(MAKE_DIRECTORY ${CMAKE_RUNTIME_OUTPUT_DIRECTORY})
foreach(folder IN ITEMS assets shaders)
  file(RELATIVE_PATH target ${CMAKE_RUNTIME_OUTPUT_DIRECTORY} ${PROJECT_SOURCE_DIR}/${folder})
  file(CREATE_LINK ${target} ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/${folder} SYMBOLIC)
endforeach()
