# The two commands of the README are `make demo` and `make test`. Behind this file stands Meson.

build   ?= build
prefix  ?= /usr/local
DESTDIR ?=
time    ?= 60
MAKEFLAGS += --no-print-directory
# Meson asks dpkg-architecture for Debian's folder of libraries, and takes lib64 if it is missing: neither the loader nor pkg-config
# looks there. The compiler knows the folder too; it prints nothing where there is none.
folders  = --prefix=$(prefix) $$(gcc -print-multiarch 2>/dev/null | sed 's:.:--libdir=lib/&:')

.PHONY: all demo web npm python site test test-more test-long test-packages lint fuzz test-gl test-debian13 bench bench-check bench-check-record docs gallery install uninstall deb static windows release clean help

all: $(build)/lambent

help:
	@echo 'make            builds $(build)/lambent (missing Debian packages are installed first)'
	@echo 'make demo       builds and renders a textured cow with a glaze to out/demo.png'
	@echo 'make web        builds the WebAssembly module and the page, in build-web/'
	@echo 'make python     builds the Python package as a wheel, in build-python/ (docs/python.md)'
	@echo 'make npm        packs the npm package, build-web/lambent-VERSION.tgz (docs/npm.md)'
	@echo 'make site       writes README and docs/ as pages, in build-site/; figures open in the Lab'
	@echo 'make test       builds with gcc, and with clang and sanitizers, and runs the tests of every change (docs/testing.md)'
	@echo 'make test-more  what continuous integration runs besides: clang, threads, the page in a browser, larger shares of tables'
	@echo 'make test-long  the rest: whole tables, all with sanitizers, kills, 20,000 pictures, other processors under qemu, a Slurm'
	@echo 'make test-packages  builds every package twice, installs, uses and removes it, and prints a table (part of make test-long)'
	@echo 'make test-gl    the tests of OpenGL alone; names the driver that they ran on'
	@echo 'make test-debian13  make demo and make test on a fresh Debian 13 root, in build-debian13/ (needs root)'
	@echo 'make fuzz       fuzzes every reader and the drawing, a minute each (time=1200 targets="obj ply")'
	@echo 'make lint       cppcheck and clang-tidy over src, program, classroom and tools'
	@echo 'make bench      measures against other programs, into bench/results and docs/speed.md (BENCH=full: everything;'
	@echo '                BENCH=large: a file of 5 GB; LAMBENT_MODELS=FOLDER: rows of its models too)'
	@echo 'make bench-check         counts instructions, beside the recorded ones (part of make test-more)'
	@echo 'make bench-check-record  records them anew, where they were meant to change'
	@echo 'make install    installs to $$(DESTDIR)$$(prefix), prefix=$(prefix)'
	@echo 'make uninstall  removes what install put there'
	@echo 'make deb        builds the Debian packages of the committed tree, in build-deb/ (docs/install.md)'
	@echo 'make static     builds one program without shared libraries, build-static/lambent (machine=aarch64: for ARM)'
	@echo 'make windows    builds lambent.exe and lambent.dll for Windows by mingw-w64, in build-windows/'
	@echo 'make release    builds packages, static programs and the source in dist/, with checksums and the changes'
	@echo 'make docs       writes the generated parts of docs/ anew, the pictures of the README, and $(build)/docs/reference.md'
	@echo 'make gallery    all pictures of docs/: those of make docs, and the known mistakes'
	@echo 'make clean      removes everything that was built'

$(build)/build.ninja:
	@scripts/setup.sh build
	meson setup $(build) --buildtype=release $(folders) -Dtests=false

.PHONY: $(build)/lambent
$(build)/lambent: $(build)/build.ninja
	@scripts/setup.sh build
	ninja -C $(build)

demo: $(build)/lambent
	@mkdir -p out
	@$(build)/lambent examples/models/spot.glb --azimuth 150 --ground -b '#dfe6ee' -s 800 -o out/demo.png
	@echo 'The picture: out/demo.png'
	@echo 'Try next:'
	@echo '    $(build)/lambent MODEL -b white -o out/model.png                    your own .glb, .obj, .stl or .ply file'
	@echo '    $(build)/lambent compare gyroid --across material=jade,ruby,obsidian -o out/materials.png'
	@echo '    $(build)/lambent torus-knot --turntable 24 -s 320 -o out/turn.webp  a turning model'

web:
	@scripts/setup.sh build web
	@python3 web/build.py build-web

# Debian's Python, whatever another one is called python3: it has Debian's NumPy and cffi.
python: $(build)/lambent
	@scripts/setup.sh python
	@/usr/bin/python3 python/make_wheel.py $(build) build-python

npm: web
	@command -v npm >/dev/null || scripts/setup.sh npm
	@python3 web/npm.py build-web

site: $(build)/lambent web
	@python3 scripts/make_site.py $(build)/lambent build-site

test:
	@scripts/setup.sh build test
	@scripts/setup.sh python || true # optional: without it the Python package is not tested
	@python3 tests/run.py

test-more:
	@scripts/setup.sh build test
	@scripts/setup.sh web browser || true # optional: what is missing is skipped
	@command -v npm >/dev/null || scripts/setup.sh npm || true
	@python3 tests/run.py more

test-gl:
	@scripts/setup.sh build test
	@python3 tests/run.py gl

test-long:
	@scripts/setup.sh build test
	@scripts/setup.sh long package web windows browser cross python fresh || true # optional: what is missing is skipped
	@command -v npm >/dev/null || scripts/setup.sh npm || true
	@python3 tests/run.py long

test-packages: $(build)/lambent
	@scripts/setup.sh package web long windows browser cross python fresh || true # optional: what is missing is "not run"
	@command -v npm >/dev/null || scripts/setup.sh npm || true
	@python3 tests/long/table.py $(build)/lambent

# Exceptions stand in tests/lint/cppcheck.txt and .clang-tidy, with their reasons.
lint: $(build)/lambent
	@scripts/setup.sh lint
	@python3 tests/lint/lint.py $(build)

# Needs clang; builds in build-fuzz/, where the inputs found so far are kept (docs/fuzzing.md).
fuzz:
	@scripts/setup.sh build test
	@python3 tests/fuzz/fuzz.py time=$(time) $(targets)

test-debian13:
	@scripts/fresh_root.sh trixie build-debian13 'make demo; sha256sum out/demo.png; make test'

# A build of its own, of the release kind whatever $(build) is; models and pictures lie there too.
bench:
	@scripts/setup.sh build bench
	@test -e build-bench/build.ninja || meson setup build-bench --buildtype=release -Dtests=false -Dbench=true
	@ninja -C build-bench
	@python3 bench/$(if $(filter large,$(BENCH)),large.py --write,run.py)

bench-check bench-check-record: $(build)/lambent
	@scripts/setup.sh test
	@python3 bench/check.py $(build)/lambent $(if $(findstring record,$@),--record)

# The prefix is baked into lambent.pc: configured before the build that makes it. The page of `make web` is installed where it is there by now.
install: $(build)/build.ninja
	@scripts/setup.sh build
	meson setup --reconfigure $(build) $(folders)
	ninja -C $(build)
	DESTDIR=$(DESTDIR) meson install -C $(build)
	@test -n '$(DESTDIR)' || $(ldconfig)
	@test -n '$(DESTDIR)' || pkg-config --exists lambent || find '$(prefix)' -name lambent.pc -printf \
	    'To use the library: export PKG_CONFIG_PATH=%h LD_LIBRARY_PATH=%h/..\n'

# The loader finds libraries by a list, which only root can write.
ldconfig = PATH=$$PATH:/usr/sbin:/sbin ldconfig 2>/dev/null || true

# Removes exactly the files that an install with the same DESTDIR and prefix puts there, and folders that are empty then.
uninstall: $(build)/build.ninja
	@meson configure $(build) $(folders)
	@ninja -C $(build) >/dev/null
	@meson introspect --installed $(build) | python3 scripts/uninstall.py '$(DESTDIR)' '$(prefix)'
	@test -n '$(DESTDIR)' || $(ldconfig)

deb:
	@scripts/setup.sh build package web
	@command -v npm >/dev/null || scripts/setup.sh npm
	@packaging/deb.sh build-deb

# make static machine=aarch64 compiles for another machine, in build-static-aarch64/.
static:
	@scripts/setup.sh build $(if $(machine),cross)
	@python3 packaging/static.py build-static$(if $(machine),-$(machine) $(machine))

windows:
	@scripts/setup.sh build windows
	@python3 packaging/windows.py build-windows

release:
	@scripts/setup.sh build package cross
	@python3 packaging/release.py dist

docs: $(build)/lambent
	@ninja -C $(build) docs/reference.md
	@python3 scripts/docs.py $(build)/lambent
	@ninja -C $(build)
	@python3 scripts/tone_plot.py $(build)

gallery: docs
	@ninja -C $(build) docs/mistakes docs/shadow-mistakes
	$(build)/docs/mistakes docs/pictures
	$(build)/docs/shadow-mistakes examples/shadows.json docs/pictures

clean:
	rm -rf build build-* out dist
