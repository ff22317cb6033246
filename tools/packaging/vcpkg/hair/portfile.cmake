# The port builds the source tree in which it lies, by make.
get_filename_component(source_tree "${CURRENT_PORT_DIR}/../../../.." ABSOLUTE)
set(SOURCE_PATH "${CURRENT_BUILDTREES_DIR}/src/hair")
set(sources Makefile LICENSE include lib glsl tools tests/consumer tests/gates.mk tests/fuzz/fuzz.mk)

file(REMOVE_RECURSE "${SOURCE_PATH}")
foreach(name IN LISTS sources)
    get_filename_component(folder "${SOURCE_PATH}/${name}" DIRECTORY)
    file(COPY "${source_tree}/${name}" DESTINATION "${folder}")
endforeach()

vcpkg_cmake_get_vars(cmake_vars_file)
include("${cmake_vars_file}")
find_program(MAKE make REQUIRED)
if("egl" IN_LIST FEATURES)
    message(STATUS "The feature egl needs the headers and the library of EGL from the system, such as libegl-dev of Debian.")
endif()

# Build and install the libraries of one configuration of make.
function(install_libraries name config prefix c_flags)
    file(COPY "${SOURCE_PATH}/" DESTINATION "${CURRENT_BUILDTREES_DIR}/${TARGET_TRIPLET}-${name}")
    vcpkg_execute_build_process(
        COMMAND "${MAKE}" install-libraries "-j${VCPKG_CONCURRENCY}" SETUP=0 VIEW=0 BULLET=0 WARN= "config=${config}"
            "CC=${VCPKG_DETECTED_CMAKE_C_COMPILER}" "AR=${VCPKG_DETECTED_CMAKE_AR}" "CFLAGS=${c_flags}"
            "PREFIX=${prefix}" CMAKEDIR=share/hair
        WORKING_DIRECTORY "${CURRENT_BUILDTREES_DIR}/${TARGET_TRIPLET}-${name}"
        LOGNAME "install-${TARGET_TRIPLET}-${name}"
    )
    set(unwanted "${prefix}/lib/*.a")
    if(VCPKG_LIBRARY_LINKAGE STREQUAL "static")
        set(unwanted "${prefix}/lib/*.so*")
    endif()
    file(GLOB files "${unwanted}")
    if(NOT "egl" IN_LIST FEATURES)
        file(GLOB egl "${prefix}/lib/libhair_egl*" "${prefix}/lib/pkgconfig/hair_egl.pc" "${prefix}/include/hair/hair_egl.h")
        list(APPEND files ${egl})
    endif()
    file(REMOVE ${files} "${prefix}/include/hair/hair_bullet.h" "${prefix}/lib/pkgconfig/hair_bullet.pc")
endfunction()

install_libraries(rel release "${CURRENT_PACKAGES_DIR}" "${VCPKG_DETECTED_CMAKE_C_FLAGS}")
if(NOT VCPKG_BUILD_TYPE)
    install_libraries(dbg debug "${CURRENT_PACKAGES_DIR}/debug" "${VCPKG_DETECTED_CMAKE_C_FLAGS}")
    file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
endif()
vcpkg_fixup_pkgconfig()

file(INSTALL "${CURRENT_PORT_DIR}/usage" DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
