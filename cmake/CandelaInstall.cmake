# SPDX-License-Identifier: MIT
# What `cmake --install` puts where, and the Debian package that `cpack` makes of it in the build folder.

include(GNUInstallDirs)
install(TARGETS candela)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/assets/ DESTINATION ${CMAKE_INSTALL_DATADIR}/candela/assets
        PATTERN "*.py" EXCLUDE)
set(from ${PROJECT_SOURCE_DIR}/app/install)
install(FILES ${from}/candela.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
install(FILES ${from}/candela.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages)
install(FILES ${from}/candela.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps)
install(FILES ${from}/candela.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${from}/candela.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME candela)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/candela RENAME copyright)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME candela)
set(CPACK_PACKAGE_CONTACT "The candela authors <candela@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "interactive path-tracing viewer for glTF scenes")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
    "Opens glTF 2.0 scenes and shows them converge to the light that is in them, in\n a window or without any display. Unbiased by default, with its own error stated.")
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Loaded while running: what the off-screen and the on-screen window draw with, and the letters of the panels.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "fonts-dejavu-core, libgl1-mesa-dri")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
include(CPack)
