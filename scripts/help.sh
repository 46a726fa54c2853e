# shellcheck shell=sh
# Sourced first by the scripts: --help prints the comment at a script's beginning, and nothing is done; an option that is not
# one of $options is refused.
case ${1:-} in
-h | --help)
    awk 'NR > 1 { if (!/^#/) exit; sub(/^# ?/, ""); print }' "$0"
    exit 0
    ;;
-*)
    case " ${options:-} " in
    *" $1 "*) ;;
    *) echo "$(basename "$0"): unknown option $1; --help says what there is" >&2 && exit 2 ;;
    esac
    ;;
esac
