# packaging.mk - the installed tree and the packages that are made from the tree.

LIBDIR ?= lib
TREE    = $(DESTDIR)$(PREFIX)
DOC     = $(TREE)/share/doc/hair
LIBS    = $(TREE)/$(LIBDIR)
# The folder of the CMake config, below PREFIX.
CMAKEDIR ?= $(LIBDIR)/cmake/hair
PROGRAMS := $(filter-out %/hair-gallery,$(TOOLS))

empty :=
# The installed files find their tree relative to their own folder, two or more levels below PREFIX.
up       = $(subst $(empty) ,/,$(patsubst %,..,$(subst /, ,$(1))))
UP       = $(call up,$(LIBDIR)/pkgconfig)
CMAKE_UP = $(call up,$(CMAKEDIR))
POINTER  = $(shell echo __SIZEOF_POINTER__ | $(CC) -E -P -)
TEMPLATE = sed 's|@UP@|$(UP)|g; s|@CMAKE_UP@|$(CMAKE_UP)|g; s|@LIBDIR@|$(LIBDIR)|g; s|@VERSION@|$(VERSION)|g; s|@MAJOR@|$(MAJOR)|g; s|@POINTER@|$(POINTER)|g'

install: install-libraries install-tools ## Everything that users need, into DESTDIR/PREFIX

# The links of the installed guide lead to the installed headers.
install-libraries: libraries
	install -d $(TREE)/include/hair $(LIBS)/pkgconfig $(TREE)/$(CMAKEDIR) $(DOC)/examples
	install -m 644 include/hair/*.h $(TREE)/include/hair
	install -m 644 $(filter %.a,$(LIBRARIES)) $(LIBS)
	cp -P $(foreach so,$(filter %.so,$(LIBRARIES)),$(so) $(so).$(MAJOR) $(so).$(VERSION)) $(LIBS)
	for n in $(NAMES); do $(TEMPLATE) tools/packaging/$$n.pc.in >$(LIBS)/pkgconfig/$$n.pc || exit 1; done
	for n in hairConfig hairConfigVersion; do $(TEMPLATE) tools/packaging/$$n.cmake.in >$(TREE)/$(CMAKEDIR)/$$n.cmake || exit 1; done
	install -m 644 LICENSE $(DOC)
	install -m 644 tests/consumer/hello.c $(wildcard tools/examples/*.[ch] tools/examples/*.cpp tools/examples/*.vert tools/examples/*.frag tools/examples/README.md) $(DOC)/examples
	sed 's|](hair|](../../../include/hair/hair|g; s|](../../tests/consumer/|](examples/|; s|](../../tools/|](|' include/hair/README.md >$(DOC)/guide.md
	sed 's|](README.md|](guide.md|g' include/hair/CHANGELOG.md >$(DOC)/CHANGELOG.md

# Manual pages have the text of --help.
install-tools: $(PROGRAMS)
	install -d $(TREE)/bin $(TREE)/share/man/man1 $(TREE)/share/bash-completion/completions $(DOC)/scenes
	install $(PROGRAMS) $(TREE)/bin
	for n in $(notdir $(PROGRAMS)); do $(B)/$$n --help | awk -v version=$(VERSION) -f tools/packaging/man.awk >$(TREE)/share/man/man1/$$n.1 && \
	  install -m 644 tools/packaging/completion.bash $(TREE)/share/bash-completion/completions/$$n || exit 1; done
	install -m 644 tools/scenes/* $(DOC)/scenes

AMALGAM := build/amalgam
amalgam: $(AMALGAM)/hair.c ## build/amalgam: all of libhair as one hair.c with its headers
AMALGAMATED := $(patsubst $(B)/%.o,%,$(filter $(B)/lib/%,$(LIB))) $(B)/gen/sources.c
$(AMALGAM)/hair.c: $(AMALGAMATED) $(wildcard $(ROOMS:%=lib/%/*.h) lib/*/*.inl lib/*/*/*.inl include/hair/*.h) $(GLSL) tools/packaging/amalgam.awk
	@rm -rf $(AMALGAM) && mkdir -p $(AMALGAM)/hair
	$(call say,$@)
	@cp $(filter-out %/hair_egl.h %/hair_bullet.h,$(wildcard include/hair/*.h)) $(AMALGAM)/hair
	@cp LICENSE $(AMALGAM)
	@awk -v version=$(VERSION) -f tools/packaging/amalgam.awk $(AMALGAMATED) >$@

# The objects are built anew, because the system finds libraries without a path in the files.
MULTIARCH = $(shell $(CC) -dumpmachine | sed 's/i.86-/i386-/')
DEB      := build/deb
deb: ## build/deb: Debian packages of libraries, development files and tools, which lintian accepts
	@rm -rf $(DEB)/hair $(DEB)/*.deb $(DEB)/*.changes && mkdir -p $(DEB)/hair/debian
	@$(MAKE) -j$(JOBS) B=$(DEB)/release BESIDE= libraries tools
	@$(MAKE) B=$(DEB)/release BESIDE= SETUP=0 install DESTDIR=$(abspath $(DEB))/hair/tree PREFIX=/usr LIBDIR=lib/$(MULTIARCH) \
	  DOC=$(abspath $(DEB))/hair/tree/usr/share/doc/libhair-dev >/dev/null
	@sh tools/packaging/deb.sh $(DEB) $(VERSION)

# The port builds this tree with the libraries of both kinds. CMake then builds a program with each.
VCPKG_PORT := tools/packaging/vcpkg
VCPKG_TREE := $(abspath build/vcpkg)
VCPKG      ?= vcpkg
test-vcpkg: port-version ## Install the port of vcpkg and build a program with it; set VCPKG to the tool, and VCPKG_ROOT
	@command -v $(VCPKG) >/dev/null && [ -e "$(VCPKG_ROOT)/scripts/buildsystems/vcpkg.cmake" ] || \
	  { echo "make test-vcpkg needs vcpkg: set VCPKG to the program and VCPKG_ROOT to its folder."; exit 1; }
	@rm -rf $(VCPKG_TREE) && mkdir -p $(VCPKG_TREE)/downloads
	@for triplet in x64-linux x64-linux-dynamic; do \
	  $(VCPKG) install "hair[egl]:$$triplet" --vcpkg-root=$(VCPKG_ROOT) --overlay-ports=$(VCPKG_PORT) --binarysource=clear \
	    --x-install-root=$(VCPKG_TREE)/installed --x-buildtrees-root=$(VCPKG_TREE)/buildtrees \
	    --x-packages-root=$(VCPKG_TREE)/packages --downloads-root=$(VCPKG_TREE)/downloads || exit 1; \
	  for type in Debug Release; do consumer=$(VCPKG_TREE)/consumer-$$triplet-$$type; \
	    cmake -S tools/packaging/conan/test_package -B $$consumer -DCMAKE_BUILD_TYPE=$$type -DVCPKG_TARGET_TRIPLET=$$triplet \
	      -DCMAKE_TOOLCHAIN_FILE=$(VCPKG_ROOT)/scripts/buildsystems/vcpkg.cmake -DVCPKG_INSTALLED_DIR=$(VCPKG_TREE)/installed && \
	    cmake --build $$consumer && $$consumer/groom || exit 1; done; done
port-version:
	@grep -q '"version": "$(VERSION)"' $(VCPKG_PORT)/hair/vcpkg.json || { echo "$(VCPKG_PORT)/hair/vcpkg.json is not of version $(VERSION)"; exit 1; }

.PHONY: test-vcpkg port-version amalgam deb install install-libraries install-tools
