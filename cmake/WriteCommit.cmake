# Writes the header OUTPUT with the commit that SOURCE_DIR is a clone at, at the time of building. The header is left
# alone where it says so already, so that what includes it is compiled again only after a commit.
#
#   cmake -D SOURCE_DIR=... -D TEMPLATE=... -D OUTPUT=... -P WriteCommit.cmake

function(git result)
    execute_process(COMMAND ${git_program} --no-optional-locks ${ARGN}
        WORKING_DIRECTORY ${SOURCE_DIR}
        OUTPUT_VARIABLE output OUTPUT_STRIP_TRAILING_WHITESPACE
        ERROR_QUIET
        RESULT_VARIABLE status)
    if(NOT status EQUAL 0)
        set(output "")
    endif()
    set(${result} "${output}" PARENT_SCOPE)
endfunction()

set(footfall_commit "")
find_program(git_program git)
if(git_program)
    # The files of a release may lie within a clone of something else.
    git(top rev-parse --show-toplevel)
    file(REAL_PATH "${SOURCE_DIR}" source)
    if(top STREQUAL source)
        git(footfall_commit rev-parse --short=9 HEAD)
        git(changed status --porcelain --untracked-files=no)
        if(footfall_commit AND changed)
            string(APPEND footfall_commit "+")
        endif()
    endif()
endif()
configure_file(${TEMPLATE} ${OUTPUT} @ONLY)
