#!/bin/sh
# scripts/template.sh without the tools that it needs: one sentence that names one command, and exit 0, since the libraries and the tool are built
# without it. Truth: a PATH with nothing but what the script itself calls.
set -u
work=$OVOID_BUILD_DIR/test_template
rm -rf "$work" && mkdir -p "$work/bin"
for tool in sh dirname find cmp cp mkdir; do ln -s "$(command -v $tool)" "$work/bin/$tool"; done
said=$(PATH=$work/bin "$OVOID_SOURCE_DIR/scripts/template.sh" "$work" 2>&1)
code=$?
wanted='template: --html has no page yet: node is not here; "make page" installs what is missing and builds it'
if [ $code -eq 0 ] && [ "$said" = "$wanted" ] && [ ! -e "$work/page.html" ]; then
    echo "1 passed, 0 failed, 0 skipped"
else
    printf 'FAILED: exit %d, said "%s"\n' $code "$said"
    echo "0 passed, 1 failed, 0 skipped"
    exit 1
fi
