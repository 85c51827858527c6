# find_package(incircle) gives the targets incircle::incircle, which is shared, and incircle::static.
get_filename_component(_prefix "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
foreach(_kind shared static)
    if(NOT TARGET incircle::${_kind})
        string(TOUPPER ${_kind} _upper)
        add_library(incircle::${_kind} ${_upper} IMPORTED)
        set_target_properties(incircle::${_kind} PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${_prefix}/include")
    endif()
endforeach()
set_target_properties(incircle::shared PROPERTIES
    IMPORTED_LOCATION "${_prefix}/lib/libincircle_c.so.1" IMPORTED_SONAME libincircle_c.so.1)
set_target_properties(incircle::static PROPERTIES
    IMPORTED_LOCATION "${_prefix}/lib/libincircle_c.a" INTERFACE_LINK_LIBRARIES "gcc_s;pthread;m;dl")
if(NOT TARGET incircle::incircle)
    add_library(incircle::incircle ALIAS incircle::shared)
endif()
