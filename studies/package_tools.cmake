# What cpack needs for the Debian package, or it would leave out the libraries that the program depends on.
foreach(tool IN ITEMS file dpkg-shlibdeps)
  find_program(found_${tool} ${tool})
  if(NOT found_${tool})
    message(FATAL_ERROR "the Debian package is made with ${tool}: apt-get install dpkg-dev file")
  endif()
endforeach()
