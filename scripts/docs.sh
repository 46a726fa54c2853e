#!/bin/sh
# docs.sh: the manual into build/docs/html. Exit 1 where Doxygen warns: a public function, type, value or macro without
# a word, a broken link. Fields are excepted: a struct's comment may explain them together.
set -u
cd "$(dirname "$0")/.." || exit 1
mkdir -p build/docs
doxygen docs/Doxyfile 2>build/docs/said.log || { cat build/docs/said.log; exit 1; }
if grep -v '(variable) of \(struct\|union\)' build/docs/said.log; then exit 1; fi
echo "build/docs/html/index.html"
