# Manual pages and completions, which the program itself describes: `man surimi`, `man surimi-bake`.
find_program(SURIMI_HELP2MAN help2man)
mark_as_advanced(SURIMI_HELP2MAN)
set(manual_folder ${CMAKE_BINARY_DIR}/manual)
file(MAKE_DIRECTORY ${manual_folder})
set(manual_files)

# Makes FILE by a command, and installs it.
function(surimi_manual file destination name)
  add_custom_command(OUTPUT ${manual_folder}/${file} DEPENDS surimi COMMAND ${ARGN} > ${manual_folder}/${file})
  install(FILES ${manual_folder}/${file} DESTINATION ${destination} RENAME ${name} COMPONENT program)
  set(manual_files ${manual_files} ${manual_folder}/${file} PARENT_SCOPE)
endfunction()

set(data ${CMAKE_INSTALL_DATADIR})
surimi_manual(surimi.bash ${data}/bash-completion/completions surimi surimi completion bash)
surimi_manual(surimi.zsh ${data}/zsh/vendor-completions _surimi surimi completion zsh)
surimi_manual(surimi.fish ${data}/fish/vendor_completions.d surimi.fish surimi completion fish)
if(SURIMI_HELP2MAN)
  set(page ${SURIMI_HELP2MAN} --no-info --version-string=${PROJECT_VERSION} --manual=Surimi --source=Surimi)
  surimi_manual(surimi.1 ${CMAKE_INSTALL_MANDIR}/man1 surimi.1
    ${page} "--name=bakes visibility maps for monitor light" $<TARGET_FILE:surimi>)
  foreach(command inspect unwrap bake preview compare ratio study plan validate doctor completion)
    surimi_manual(surimi-${command}.1 ${CMAKE_INSTALL_MANDIR}/man1 surimi-${command}.1
      ${page} --help-option=--help-all "--name=surimi ${command}" "\"$<TARGET_FILE:surimi> ${command}\"")
  endforeach()
else()
  message(STATUS "no manual pages: there is no help2man")
endif()
add_custom_target(manual ALL DEPENDS ${manual_files})
