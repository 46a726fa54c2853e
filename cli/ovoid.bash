# Completion of the command `ovoid` for bash. What can follow is asked of the tool itself (ovoid complete), so this file
# knows no option by name.
# shellcheck shell=bash

# Words from standard input that begin with $1.
_ovoid_match() {
    local word
    while IFS= read -r word; do
        if [[ $word == "$1"* ]]; then COMPREPLY+=("$word"); fi
    done
}

# Files and folders that begin with $1.
_ovoid_files() {
    local word
    while IFS= read -r word; do
        if [[ -d $word ]]; then word+=/; fi
        COMPREPLY+=("$word")
    done < <(compgen -f -- "$1")
    compopt -o nospace -o filenames 2>/dev/null
}

_ovoid() {
    local tool=${COMP_WORDS[0]} current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}
    local command=${COMP_WORDS[1]} tab=$'\t' line kind choices
    COMPREPLY=()
    if ((COMP_CWORD == 1)); then
        _ovoid_match "$current" < <("$tool" complete 2>/dev/null && printf '%s\n' help --help --version)
        return
    fi
    if [[ $command == help ]]; then
        _ovoid_match "$current" < <("$tool" complete 2>/dev/null)
        return
    fi
    # The commands of a command.
    local words
    words=$("$tool" complete "$command" 2>/dev/null | grep -E "^[a-z]+${tab}command$tab" | cut -f 1)
    if [[ -n $words ]]; then
        if ((COMP_CWORD == 2)); then
            _ovoid_match "$current" < <(printf '%s\n' "$words" --help)
            return
        fi
        command="$command ${COMP_WORDS[2]}"
    fi
    # The shell breaks --name=value into three words.
    if [[ $current == "=" ]]; then current=; fi
    if [[ $previous == "=" ]]; then previous=${COMP_WORDS[COMP_CWORD - 2]}; fi
    # The value of the option before.
    # shellcheck disable=SC2086 # one word, or two
    line=$("$tool" complete $command 2>/dev/null | grep -m 1 -F -e "$previous$tab")
    if [[ $previous == -* && $line == "$previous$tab"* ]]; then
        IFS=$tab read -r _ kind choices <<<"$line"
        case $kind in
        choice) _ovoid_match "$current" < <(tr '|' '\n' <<<"$choices") && return ;;
        file) _ovoid_files "$current" && return ;;
        value) return ;;
        esac
        if [[ $kind != flag ]]; then return; fi
    fi
    # An option, or a file.
    if [[ $current == -* ]]; then
        # shellcheck disable=SC2086
        _ovoid_match "$current" < <("$tool" complete $command 2>/dev/null | cut -f 1)
    else
        _ovoid_files "$current"
    fi
}

complete -F _ovoid ovoid
