# At build time: the file with the commit; touched only where it changes.
execute_process(COMMAND git describe --always --dirty --abbrev=10 --exclude=* WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE commit
  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT commit)
  set(commit unknown)
endif()
file(CONFIGURE OUTPUT ${FILE} CONTENT "// The commit that the benchmark was built from.
extern const char bench_commit[];
const char bench_commit[] = \"${commit}\";
")
