# The two commands of the README are `make demo` and `make test`. Behind this file stands Meson.

build   ?= build
prefix  ?= /usr/local
DESTDIR ?=
MAKEFLAGS += --no-print-directory

.PHONY: all demo test bench docs gallery install uninstall clean help

all: $(build)/lambent

help:
	@echo 'make            builds $(build)/lambent (missing Debian packages are installed first)'
	@echo 'make demo       builds and renders the Utah teapot to out/demo.png'
	@echo 'make test       builds and runs the whole test suite, both compilers, with sanitizers'
	@echo 'make bench      measures, into bench/results'
	@echo 'make install    installs to $$(DESTDIR)$$(prefix), prefix=$(prefix)'
	@echo 'make uninstall  removes what install put there'
	@echo 'make docs       writes the generated parts of docs/ anew, and the pictures of the README'
	@echo 'make gallery    all pictures of docs/: those of make docs, and the known mistakes'
	@echo 'make clean      removes everything that was built'

$(build)/build.ninja:
	@scripts/setup.sh build
	meson setup $(build) --buildtype=release --prefix=$(prefix) -Dtests=false

.PHONY: $(build)/lambent
$(build)/lambent: $(build)/build.ninja
	@scripts/setup.sh build
	ninja -C $(build)

demo: $(build)/lambent
	@mkdir -p out
	@$(build)/lambent teapot -o out/demo.png
	@echo 'The picture: out/demo.png'
	@echo 'Next, try:   $(build)/lambent torus-knot --background white -o out/knot.png'

test:
	@scripts/setup.sh build test
	@python3 tests/run.py

bench:
	@scripts/setup.sh build test bench
	@$(MAKE) all
	@python3 bench/run.py

# The prefix is baked into lambent.pc: configured before the build that makes it.
install: $(build)/build.ninja
	@scripts/setup.sh build
	meson configure $(build) --prefix=$(prefix)
	ninja -C $(build)
	DESTDIR=$(DESTDIR) meson install -C $(build)

# Removes exactly the files that an install with the same DESTDIR and prefix puts there.
uninstall: $(build)/build.ninja
	@meson configure $(build) --prefix=$(prefix)
	@ninja -C $(build) >/dev/null
	@meson introspect --installed $(build) | python3 scripts/uninstall.py '$(DESTDIR)'

docs: $(build)/lambent
	@python3 scripts/docs.py $(build)/lambent

gallery: docs
	@ninja -C $(build) docs/mistakes
	$(build)/docs/mistakes docs/pictures

clean:
	rm -rf build build-* out
