# Dependencies point one way: layers.txt has the order of our own rooms. Each row here: folder | what its files must
# not include besides.
set(rules
  "core|<(Q[A-Z]|vtk|opencv2|dcmtk)"
  "imaging|<(Q[A-Z]|vtk)"
  "clinical|<(Q[A-Z]|vtk|opencv2|dcmtk)"
  "app/model|\"app/scene/|<(QWidget|QtWidgets|vtk|opencv2|dcmtk)"
  "app/mesh|\"app/scene/|<(Q[A-Z]|opencv2|dcmtk)"
  "app/scene|<(Q[A-Z]|opencv2|dcmtk)"
  "app/plot|<(QWidget|QtWidgets|vtk|opencv2|dcmtk)"
  "app/report|<(QWidget|QtWidgets|opencv2|dcmtk)"
  "app/experiments|\"app/(plot|scene)/|<(Q[A-Z]|vtk|opencv2|dcmtk)"
  "app/widgets|<(opencv2|dcmtk)"
  "app/cli|\"app/(model|widgets)/|<(QWidget|QtWidgets|vtk|opencv2|dcmtk)")
# Public headers show std and Eigen only; what a solver or a file needs stays in .cpp and *_residuals.h, *_json.h.
set(hidden "<(ceres|nlohmann|opencv2|dcmtk|openssl|pugixml)")

set(bad "")
foreach(rule ${rules})
  string(REGEX MATCH "^([^|]*)\\|(.*)$" _ "${rule}")
  set(folder ${CMAKE_MATCH_1})
  set(pattern ${CMAKE_MATCH_2})
  file(GLOB_RECURSE files ${ROOT}/${folder}/*.h ${ROOT}/${folder}/*.cpp)
  foreach(file ${files})
    file(STRINGS ${file} hits REGEX "^ *#include *(${pattern})")
    if(hits)
      string(APPEND bad "${file}: ${hits}\n")
    endif()
  endforeach()
endforeach()

file(GLOB_RECURSE headers ${ROOT}/core/*.h ${ROOT}/imaging/*.h ${ROOT}/clinical/*.h)
foreach(file ${headers})
  if(NOT file MATCHES "_(residuals|json|internal)\\.h$")
    file(STRINGS ${file} hits REGEX "^ *#include *(${hidden})")
    if(hits)
      string(APPEND bad "${file}: ${hits}\n")
    endif()
  endif()
endforeach()
# Every room may use what lies below it.
file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/layers.txt rooms REGEX "^[^#]")
file(GLOB_RECURSE sources RELATIVE ${ROOT} ${ROOT}/core/*.h ${ROOT}/core/*.cpp ${ROOT}/imaging/*.h ${ROOT}/imaging/*.cpp
     ${ROOT}/clinical/*.h ${ROOT}/clinical/*.cpp ${ROOT}/app/*.h ${ROOT}/app/*.cpp)
foreach(file ${sources})
  if(file MATCHES "_test\\.(h|cpp)$")
    string(APPEND bad "${file}: files named _test live under tests/\n")
  endif()
  get_filename_component(room ${file} DIRECTORY)
  list(FIND rooms "${room}" own)
  if(own EQUAL -1)
    string(APPEND bad "${file}: its room ${room} is not in layers.txt\n")
  endif()
  file(STRINGS ${ROOT}/${file} lines REGEX "^ *#include *\"")
  foreach(line ${lines})
    string(REGEX REPLACE "^ *#include *\"([^\"]*)/[^/\"]*\".*" "\\1" used "${line}")
    list(FIND rooms "${used}" below)
    if(below EQUAL -1 OR below GREATER own)
      string(APPEND bad "${file}: ${line}\n")
    endif()
  endforeach()
endforeach()
if(bad)
  message(FATAL_ERROR "Includes against the direction of the house:\n${bad}")
endif()
