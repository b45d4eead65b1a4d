# The hazards of area lights once more under other rounding and another compiler: runtime/ltc is headers that an engine
# compiles with its own flags. Not linked to surimi_options, which would set ours.
set(hazards ${CMAKE_CURRENT_SOURCE_DIR}/stability/ltc_hazards_test.cpp ${CMAKE_CURRENT_SOURCE_DIR}/support/quadrature.cpp)

# Multiplications fused with additions, where the machine has such instructions.
include(CheckCXXSourceRuns)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  check_cxx_source_runs("int main() { return __builtin_cpu_supports(\"fma\") && __builtin_cpu_supports(\"avx2\") ? 0 : 1; }"
    SURIMI_MACHINE_FUSES)
  set(fusing -march=haswell)
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64|arm64")
  set(SURIMI_MACHINE_FUSES TRUE) # part of the base instruction set
  set(fusing)
endif()
if(SURIMI_MACHINE_FUSES)
  add_executable(hazards_contract_fast ${hazards} stability/fused_test.cpp)
  target_include_directories(hazards_contract_fast PRIVATE ${CMAKE_SOURCE_DIR})
  target_compile_options(hazards_contract_fast PRIVATE -O2 -ffp-contract=fast ${fusing}) # GCC fuses from -O2 on
  target_link_libraries(hazards_contract_fast PRIVATE GTest::gtest_main)
  add_test(NAME stability/contract_fast COMMAND hazards_contract_fast)
else()
  message(STATUS "Skipped: test stability/contract_fast, because this machine has no fused multiply-add")
endif()

find_program(CLANGXX clang++)
if(CLANGXX)
  set(objects)
  foreach(source ${hazards})
    get_filename_component(name ${source} NAME_WE)
    set(object ${CMAKE_CURRENT_BINARY_DIR}/clang_${name}.o)
    add_custom_command(OUTPUT ${object}
      COMMAND ${CMAKE_CXX_COMPILER_LAUNCHER} ${CLANGXX} -std=c++20 -O1 -Wall -Wextra -I${CMAKE_SOURCE_DIR}
        -MD -MF ${object}.d -c ${source} -o ${object}
      DEPENDS ${source} DEPFILE ${object}.d VERBATIM)
    list(APPEND objects ${object})
  endforeach()
  set(program ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/hazards_clang)
  add_custom_command(OUTPUT ${program}
    COMMAND ${CLANGXX} ${objects} $<TARGET_FILE:GTest::gtest_main> $<TARGET_FILE:GTest::gtest> -pthread -o ${program}
    DEPENDS ${objects} VERBATIM)
  add_custom_target(hazards_clang ALL DEPENDS ${program})
  add_test(NAME stability/clang COMMAND ${program})
else()
  message(STATUS "Skipped: test stability/clang, because there is no clang++")
endif()

foreach(name contract_fast clang)
  if(TEST stability/${name})
    set_tests_properties(stability/${name} PROPERTIES LABELS stability TIMEOUT 300)
  endif()
endforeach()
