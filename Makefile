# make demo            build, simulate and render the built-in scene: build/demo.png and build/demo.mp4
# make test            build and run every test; filter=groom runs the programs whose names contain groom
# make config=asan     release (default), debug, asan, tsan, coverage
# make BULLET=0        build without libhair_bullet, libhair is unchanged
# make VIEW=0          build without hair-view, which needs SDL2 and Dear ImGui
# make bench device=0  run all cases on EGL device 0; without it, a quick run on the first that works
# make V=1             show every command
# make setup           install the missing Debian packages of tools/packages.txt; SETUP=0 skips it
MAKEFLAGS += -r --no-print-directory
config    ?= release
PREFIX    ?= /usr/local
SETUP     ?= 1
JOBS      ?= $(shell nproc)
V         ?= 0
BULLET    ?= 1
VIEW      ?= 1
filter    ?=
until     ?= 9999999999
# A compiler of MinGW makes hair.dll, without EGL, Bullet and tools, which need a desktop of Linux.
WINDOWS   := $(findstring mingw,$(shell $(CC) -dumpmachine))
HOST_CC   ?= cc
B         := build/$(if $(WINDOWS),windows-)$(config)

opt.release  := -O2 -DNDEBUG -fstack-protector-strong -fstack-clash-protection
opt.debug    := -O0
opt.asan     := -O1 -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer
opt.tsan     := -O1 -fsanitize=thread
opt.coverage := -O0 --coverage
opt.clang    := -O1
Q := $(if $(filter 0,$(V)),@)
say = $(if $(filter 0,$(V)),@echo '  $(1)')
# Files of lib/rod pass vectors of 32 bytes to each other, which GCC notes for the sake of older versions.
WARN  := -Wall -Wextra -Wshadow -Wconversion -Wno-psabi -Werror
# Builds in any folder are equal, because files have no paths outside of the project.
FLAGS := -Iinclude -I. -g -fvisibility=hidden -ffp-contract=off -ffile-prefix-map=$(CURDIR)=. -MMD -MP $(opt.$(config))
FLAGS += $(if $(filter release,$(config)),-U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=2)
ifneq ($(WINDOWS),)
override BULLET := 0
override VIEW   := 0
# Stack protection and checked functions would need a further library of MinGW.
WARN  += -Wno-float-conversion
FLAGS := $(filter-out -fstack-% -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=2,$(FLAGS)) -D__USE_MINGW_ANSI_STDIO=1
endif
# Programs need only the libraries that they use, also with sanitizers, for which GCC links all that are named.
LINK_FLAGS := -Wl,-z,relro,-z,now -Wl,-z,noexecstack -Wl,--as-needed $(LDFLAGS)
C     := $(CC) -std=c17 $(WARN) -Wmissing-prototypes $(FLAGS) $(CFLAGS)
CPP   := $(CXX) -std=c++17 -Wall -Wextra -Werror -fno-exceptions -fno-rtti $(FLAGS) $(CXXFLAGS)

VERSION := $(shell awk '/define HAIR_VERSION_(MAJOR|MINOR|PATCH)/{v=v s $$3; s="."} END{print v}' include/hair/hair_base.h)
MAJOR   := $(firstword $(subst ., ,$(VERSION)))

# Folders of lib/ in the order of the data flow. A file includes only from its own folder and from
# those before it.
# The folders egl/ and bullet/ are separate libraries.
ROOMS := base asset collide groom rod gl field wind sim strands light draw api

objects = $(patsubst %,$(B)/%.o,$(sort $(wildcard $(1))))
LIB   := $(call objects,$(ROOMS:%=lib/%/*.c)) $(B)/gen/sources.c.o
EGL   := $(call objects,lib/egl/*.c)
BUL   := $(call objects,lib/bullet/*.cpp)
REF   := $(call objects,tests/reference/*.cpp)
GLSL  := $(sort $(wildcard glsl/*.glsl glsl/*.h glsl/*/*))
TOOLS := $(B)/hair-capture $(B)/hair-groom $(B)/hair-bench $(B)/hair-gallery
TOOLS += $(if $(filter 0,$(VIEW)),,$(B)/hair-view)
TESTS := $(patsubst %.c,$(B)/%,$(wildcard tests/golden/*_test.c tests/gpu/*_test.c tests/hosts/*_test.c tests/unit/*_test.c))
TESTS += $(if $(filter 0,$(BULLET)),,$(patsubst %.cpp,$(B)/%,$(wildcard tests/unit/bullet_*_test.cpp)))
# Hosts in C++ need packages that `make hosts` installs. `make test hosts=1` runs them.
TESTS += $(if $(filter 1,$(hosts)),$(patsubst %.cpp,$(B)/%,$(wildcard tests/hosts/*_test.cpp)))
TESTS += $(if $(filter 0,$(VIEW)),,$(patsubst %.c,$(B)/%,$(wildcard tests/view/*_test.c)))
EXAMPLES := $(filter-out %/vulkan_host,$(patsubst tools/%.c,$(B)/%,$(wildcard tools/examples/*.c)))
EXAMPLES += $(if $(filter 1,$(hosts)),$(B)/examples/vulkan_host)
EXAMPLES += $(if $(filter 0,$(BULLET)),,$(B)/examples/bullet_world)

NAMES     := hair hair_egl $(if $(filter 0,$(BULLET)),,hair_bullet)
LIBRARIES := $(foreach n,$(NAMES),$(B)/lib$(n).a $(B)/lib$(n).so)
ifneq ($(WINDOWS),)
NAMES     := hair
LIBRARIES := $(B)/libhair.a $(B)/hair.dll
TOOLS     :=
endif

# Deferred variables, because pkg-config must run after `make setup` has installed the packages.
packages   = $(shell pkg-config $(1) $(2))
TOOL_CFLAGS = $(call packages,--cflags,epoxy libpng OpenEXR jansson cglm libxxhash)
TOOL_LIBS   = $(call packages,--libs,epoxy egl libpng OpenEXR jansson libxxhash) -pthread -lm
TEST_LIBS   = $(call packages,--libs,cmocka epoxy egl libpng jansson libxxhash) -pthread -lm
VIEW_CFLAGS = $(patsubst -I%,-isystem %,$(call packages,--cflags,sdl2 imgui))
VIEW_LIBS   = $(call packages,--libs,imgui sdl2) -ldl
EXAMPLE_LIBS = $(call packages,--libs,epoxy egl sdl2) -pthread -lm
EIGEN       = $(patsubst -I%,-isystem %,$(call packages,--cflags,eigen3))
BULLET_CFLAGS = $(patsubst -I%,-isystem %,$(call packages,--cflags,bullet))
# The library needs only these two of Bullet's libraries, not dynamics or soft bodies.
BULLET_LIBS   = $(filter -L% -lBulletCollision -lLinearMath,$(call packages,--libs,bullet))

all: libraries tools ## Libraries and tools, in build/$(config)
libraries: $(LIBRARIES) ## libhair, libhair_egl and libhair_bullet, static and shared
tools: $(TOOLS) ## hair-capture, hair-groom, hair-bench, hair-gallery, hair-view
examples: $(EXAMPLES) ## The programs of tools/examples/, in build/$(config)/examples

demo: setup ## The main job: build/demo.png and build/demo.mp4, a head of hair in motion
	@$(MAKE) -j$(JOBS) $(B)/hair-capture
	$(B)/hair-capture --scene demo --guides 300 --frames 30:31 --size 1280x720 --supersample 4 --followers 100000 --set strand.radius=4e-5 -o build/demo.png
	$(B)/hair-capture --scene demo --frames 0:48 --fps 24 --size 1280x720 --samples 1 --supersample 2 --set coverage=alpha --set strand.segments=16 -o build/demo.mp4

view: setup ## Build and open hair-view, a window with every option in a panel
	@$(MAKE) -j$(JOBS) $(B)/hair-view
	$(B)/hair-view

view-film: setup ## build/view.mp4: a tour of hair-view, by a script
	@$(MAKE) -j$(JOBS) $(B)/hair-view
	$(B)/hair-view --script tools/view/film.txt --frames 650 --quality 2 --set strand.segments=18 --film build/view.mp4

gallery: setup ## build/gallery.png: pictures with captions of what the library does
	@$(MAKE) -j$(JOBS) $(B)/hair-capture $(B)/hair-gallery
	$(B)/hair-gallery -o build/gallery.png

# The report shows measurements of this machine and stored measurements of others on one page. Packages of
# Debian are for the Python of the system, which may not be the first one in the path.
SUITES  := accuracy physics stability startup dispatch render shadow table paths scale bounds lod followers collision field wind skip
MACHINE := build/bench/$(if $(device),device-$(device),here)
bench: setup ## Every suite of hair-bench, into build/bench/
	@$(MAKE) -j$(JOBS) $(B)/hair-bench
	@mkdir -p $(MACHINE)
	@for suite in $(SUITES); do echo "== $$suite"; \
	  $(B)/hair-bench $$suite $(if $(device),--device $(device),--quick) --json $(MACHINE)/$$suite.json || exit 1; done

report: setup ## build/report/index.html: run time against error on one page, after make bench and make demo
	@[ "$(SETUP)" = 0 ] || sh tools/setup.sh tools/report/packages.txt
	@ls build/bench/*/*.json >/dev/null 2>&1 || $(MAKE) bench
	$(or $(wildcard /usr/bin/python3),python3) tools/report/report.py build/report/index.html build/bench/* $(wildcard .readme/*/) \
	  $(if $(wildcard build/demo.png),--picture "build/demo.png=The demo: make demo") \
	  $(if $(wildcard build/gallery.png),--picture "build/gallery.png=What the library does: make gallery") \
	  $(if $(wildcard build/view.mp4),--picture "build/view.mp4=hair-view in use: make view-film")

docs: ## build/docs/index.html: the headers of include/hair and their guide as HTML, by doxygen
	@[ "$(SETUP)" = 0 ] || sh tools/setup.sh tools/docs/packages.txt
	@mkdir -p build && rm -rf build/docs
	@doxygen tools/docs/Doxyfile

test: setup ## Every test that a change must pass
	@$(MAKE) -j$(JOBS) all examples $(TESTS)
	@$(MAKE) -j$(JOBS) check glsl consumer
	@$(MAKE) run-tests

hosts: ## Print and install the missing Debian packages of the hosts that `make test hosts=1` runs
	@[ "$(SETUP)" = 0 ] || sh tools/setup.sh tests/hosts/packages.txt

setup: ## Print and install the missing Debian packages of tools/packages.txt
	@[ "$(SETUP)" = 0 ] || sh tools/setup.sh

# GCC reads the large headers of a folder once, which is half of the time.
precompiled = $(if $(filter release,$(config)),$(if $(IS_GCC),$(B)/$(1)/precompiled.h.gch))
IS_GCC := $(shell $(CXX) --version | grep -o 'Free Software')
include_precompiled = $(patsubst %.gch,-include %,$(call precompiled,$(1)))
define precompile
@mkdir -p $(@D)
	$(call say,$@)
	$(Q)printf '#include <%s>\n' $(2) >$(@:.gch=)
	$(Q)$(CPP) $(1) -x c++-header $(@:.gch=) -o $@
endef

# Libraries ------------------------------------------------------------------------------------------------

$(B)/libhair.a: $(LIB)
$(B)/libhair_egl.a: $(EGL)
$(B)/%.a:
	@rm -f $@ && $(AR) rcsD $@ $^
# Only files of these folders define public functions, which the shared libraries export. The objects of all
# other files are in both libraries.
EXPORTING := $(B)/lib/api/% $(B)/lib/base/%
shared = $(foreach o,$(1),$(if $(filter $(EXPORTING),$(o)),$(o:.o=.shared.o),$(o)))
$(B)/libhair.so: $(call shared,$(LIB))
$(B)/libhair_egl.so: $(EGL:.o=.shared.o) $(B)/lib/base/host.c.shared.o
$(B)/libhair_egl.so: private LINK = $(call packages,--libs,egl)
$(B)/libhair_bullet.a: $(BUL)
$(B)/libhair_bullet.so: $(BUL:.o=.shared.o) $(B)/lib/base/host.c.shared.o $(B)/libhair.so
# The library finds libhair.so in its own folder, wherever the tree is. BESIDE= leaves that to the system.
BESIDE ?= -Wl,-rpath,'$$ORIGIN'
$(B)/libhair_bullet.so: private LINK = -L$(B) -lhair $(BESIDE) $(BULLET_LIBS) -lstdc++
$(B)/%.so:
	$(call say,$@)
	$(Q)$(CC) -shared $(opt.$(config)) $(LINK_FLAGS) -Wl,-soname,$*.so.$(MAJOR) $(filter %.o,$^) $(LINK) -lm -o $@.$(VERSION)
	@ln -sf $*.so.$(VERSION) $@.$(MAJOR) && ln -sf $*.so.$(MAJOR) $@

$(B)/gen/sources.c: $(B)/embed $(GLSL)
	@mkdir -p $(@D)
	$(call say,$@)
	$(Q)$(B)/embed $@ $(GLSL)
$(B)/embed: tools/embed.c
	@mkdir -p $(@D)
	$(call say,$@)
	$(Q)$(HOST_CC) -std=c17 -O1 $< -o $@
$(B)/gen/%.c.o: $(B)/gen/%.c
	$(call say,$@)
	$(Q)$(C) -fPIC -c $< -o $@
$(B)/tools/%.c.o: tools/%.c
	@mkdir -p $(@D)
	$(call say,$@)
	$(Q)$(C) $(TOOL_CFLAGS) -c $< -o $@
$(B)/tools/%.cpp.o: tools/%.cpp
	@mkdir -p $(@D)
	$(call say,$@)
	$(Q)$(CPP) $(BULLET_CFLAGS) $(TOOL_CFLAGS) -c $< -o $@
view_packages = @pkg-config --exists sdl2 imgui || { echo "hair-view needs libsdl2-dev and libimgui-dev; VIEW=0 leaves it out."; exit 1; }
$(B)/tools/view/%.cpp.o: tools/view/%.cpp
	@mkdir -p $(@D)
	$(view_packages)
	$(call say,$@)
	$(Q)$(CPP) -Wshadow $(VIEW_CFLAGS) $(TOOL_CFLAGS) $(call include_precompiled,tools/view) -c $< -o $@
$(call objects,tools/view/*.cpp): $(call precompiled,tools/view)
$(B)/tools/view/precompiled.h.gch:
	$(view_packages)
	$(call precompile,-Wshadow $(VIEW_CFLAGS) $(TOOL_CFLAGS),algorithm deque string vector imgui.h SDL.h)
$(B)/tools/examples/%.c.o: tools/examples/%.c
	@mkdir -p $(@D)
	$(call say,$@)
	$(Q)$(C) $(patsubst -I%,-isystem %,$(call packages,--cflags,epoxy sdl2)) -c $< -o $@
$(B)/tests/%.cpp.o: tests/%.cpp
	@mkdir -p $(@D)
	$(call say,$@)
	$(Q)$(CPP) $(BULLET_CFLAGS) -c $< -o $@
$(B)/tests/%.c.o: tests/%.c
	@mkdir -p $(@D)
	$(call say,$@)
	$(Q)$(C) -Wno-conversion -DHAIR_BUILD_DIR='"$(B)"' -DHAIR_BULLET=$(BULLET) -c $< -o $@
$(B)/tests/reference/%.cpp.o: tests/reference/%.cpp $(call precompiled,tests/reference)
	@mkdir -p $(@D)
	$(call say,$@)
	$(Q)$(CPP) -O2 $(EIGEN) $(call include_precompiled,tests/reference) -c $< -o $@
$(B)/tests/reference/precompiled.h.gch:
	$(call precompile,-O2 $(EIGEN),Eigen/Dense algorithm cmath vector)
$(B)/lib/bullet/%.cpp.o: lib/bullet/%.cpp
	@mkdir -p $(@D)
	$(call say,$@)
	$(Q)$(CPP) -Wshadow -Wconversion $(BULLET_CFLAGS) -fPIC -c $< -o $@
$(B)/lib/bullet/%.cpp.shared.o: lib/bullet/%.cpp
	@mkdir -p $(@D)
	$(call say,$@)
	$(Q)$(CPP) -Wshadow -Wconversion $(BULLET_CFLAGS) -fPIC -DHAIR_BUILD_SHARED -c $< -o $@
# Tools have line numbers but no variables, which take a third of the time to compile, and tests have neither.
# Other configurations have all. Tests and the viewer are optimized less for the same reason.
$(B)/tools/%: private C += $(if $(filter release,$(config)),-g1)
$(B)/tools/%: private CPP += $(if $(filter release,$(config)),-g1)
$(B)/tests/%: private C += $(if $(filter release,$(config)),-g0)
$(B)/tests/%: private CPP += $(if $(filter release,$(config)),-g0)
$(B)/tools/view/% $(B)/tests/%: private C += $(if $(filter release,$(config)),-O1)
$(B)/tools/view/% $(B)/tests/%: private CPP += $(if $(filter release,$(config)),-O1)
# Unrolled loops over small matrices prepare guides a ninth faster, with equal bits.
$(B)/lib/rod/%: private C += $(if $(filter release,$(config)),-O3)
$(B)/%.c.o: %.c
	@mkdir -p $(@D)
	$(call say,$@)
	$(Q)$(C) -fPIC -c $< -o $@
$(B)/%.c.shared.o: %.c
	@mkdir -p $(@D)
	$(call say,$@)
	$(Q)$(C) -fPIC -DHAIR_BUILD_SHARED -c $< -o $@

# Tools and tests ------------------------------------------------------------------------------------------

COMMON := $(call objects,tools/common/*.c)
$(B)/hair-%: $(B)/tools/%.c.o $(COMMON) $(B)/libhair_egl.a $(B)/libhair.a
	$(call say,$@)
	$(Q)$(CC) $(opt.$(config)) $(LINK_FLAGS) $^ $(TOOL_LIBS) -o $@
# Bullet objects of a scene, or a stub without Bullet.
WORLD := $(if $(filter 0,$(BULLET)),$(B)/tools/bullet/bullet_stub.c.o,$(B)/tools/bullet/world.cpp.o $(B)/libhair_bullet.a)
$(B)/hair-capture: $(B)/tools/capture.c.o $(WORLD) $(COMMON) $(B)/libhair_egl.a $(B)/libhair.a
	$(call say,$@)
	$(Q)$(CXX) $(opt.$(config)) $(LINK_FLAGS) $^ $(if $(filter 0,$(BULLET)),,$(BULLET_LIBS)) $(TOOL_LIBS) -o $@
$(B)/hair-bench: $(B)/tools/bench.c.o $(call objects,tools/bench/*.c) $(WORLD) $(COMMON) $(REF) $(B)/libhair_egl.a $(B)/libhair.a
	$(call say,$@)
	$(Q)$(CXX) $(opt.$(config)) $(LINK_FLAGS) $^ $(if $(filter 0,$(BULLET)),,$(BULLET_LIBS)) $(TOOL_LIBS) -o $@
$(B)/hair-view: $(call objects,tools/view/*.cpp tools/view/*.c) $(WORLD) $(COMMON) $(REF) $(B)/libhair_egl.a $(B)/libhair.a
	$(call say,$@)
	$(Q)$(CXX) $(opt.$(config)) $(LINK_FLAGS) $^ $(if $(filter 0,$(BULLET)),,$(BULLET_LIBS)) $(VIEW_LIBS) $(TOOL_LIBS) -o $@

$(B)/examples/bullet_world: $(B)/tools/examples/bullet_world.cpp.o $(B)/libhair_bullet.a $(B)/libhair_egl.a $(B)/libhair.a
	@mkdir -p $(@D)
	$(call say,$@)
	$(Q)$(CXX) $(opt.$(config)) $(LINK_FLAGS) $^ $(BULLET_LIBS) $(EXAMPLE_LIBS) -o $@
# Shaders of the example for Vulkan are compiled into arrays of C.
$(B)/tools/examples/vulkan_host.c.o: private C += -I$(B)/tools/examples $(patsubst -I%,-isystem %,$(call packages,--cflags,vulkan))
VULKAN_SHADERS := $(patsubst %,$(B)/tools/examples/vulkan_%.inc,scene.vert beads.vert scene.frag)
$(B)/tools/examples/vulkan_host.c.o: $(VULKAN_SHADERS)
$(B)/examples/vulkan_host: private EXAMPLE_LIBS += $(call packages,--libs,vulkan)
$(B)/tools/examples/%.inc: tools/examples/%
	@mkdir -p $(@D)
	@pkg-config --exists vulkan || { echo "vulkan_host needs libvulkan-dev; make hosts installs it."; exit 1; }
	$(call say,$@)
	$(Q)glslc -mfmt=c $< -o $@
$(B)/examples/%: $(B)/tools/examples/%.c.o $(B)/libhair_egl.a $(B)/libhair.a
	@mkdir -p $(@D)
	$(call say,$@)
	$(Q)$(CC) $(opt.$(config)) $(LINK_FLAGS) $^ $(EXAMPLE_LIBS) -o $@

# Archives, because a program needs a part of them only.
# Some hundred programs link the whole library. gold takes 0.06 s each without debug information, and the
# default linker 0.3 s with it.
TEST_LINK := $(if $(filter release,$(config)),-s $(if $(shell command -v ld.gold),-fuse-ld=gold))
SUPPORT := $(B)/tests/libsupport.a $(B)/tests/libreference.a
$(B)/tests/libsupport.a: $(call objects,tests/support/*.c tools/common/flip.c)
$(B)/tests/libreference.a: $(REF)
$(B)/tests/%_test: $(B)/tests/%_test.c.o $(SUPPORT) $(B)/libhair_egl.a $(B)/libhair.a
	$(call say,$@)
	$(Q)$(CXX) $(opt.$(config)) $(TEST_LINK) $^ $(TEST_LIBS) -o $@

# This test contains an example with a window.
$(B)/tests/golden/first_head_test.c.o: private C += $(patsubst -I%,-isystem %,$(call packages,--cflags,sdl2))
$(B)/tests/golden/first_head_test: private TEST_LIBS += $(call packages,--libs,sdl2)

# Programs that test the reader of glTF files of the tools.
GLTF := $(patsubst %,$(B)/tools/common/%.c.o,file gltf gltf_animation gltf_buffer gltf_mesh gltf_node json)
$(B)/tests/unit/gltf_test $(B)/tests/unit/gltf_refused_test: $(GLTF)
CHARACTER := $(patsubst %,$(B)/tools/common/%.c.o,builtin camera character character_hair groom_source head head_eyes head_parts \
  head_subdivide head_tie motion obj scene scene_bullet scene_character scene_colliders scene_cuts scene_lights scene_maps scene_wind settings \
  settings_keys)
$(B)/tests/gpu/character_test: $(CHARACTER) $(GLTF)
$(B)/tests/gpu/every_strand_test: $(CHARACTER) $(GLTF) $(patsubst %,$(B)/tools/common/%.c.o,every_strand groups)
$(B)/tests/unit/gltf_test $(B)/tests/unit/gltf_refused_test $(B)/tests/gpu/character_test $(B)/tests/gpu/every_strand_test: private TEST_LIBS := $(B)/libhair.a $(TEST_LIBS)

# Hosts have only what users of the library have.
$(B)/tests/hosts/%.c.o: tests/hosts/%.c
	@mkdir -p $(@D)
	$(call say,$@)
	$(Q)$(C) -Wno-conversion $(patsubst -I%,-isystem %,$(call packages,--cflags,epoxy sdl2)) -c $< -o $@
$(B)/tests/hosts/%_test: $(B)/tests/hosts/%_test.c.o $(B)/libhair.a
	$(call say,$@)
	$(Q)$(CC) $(opt.$(config)) $^ $(call packages,--libs,cmocka) $(EXAMPLE_LIBS) -o $@

QT = Qt6OpenGLWidgets Qt6Widgets Qt6OpenGL Qt6Gui Qt6Core
$(B)/tests/hosts/qt_test.cpp.o: private HOST_FLAGS = $(patsubst -I%,-isystem %,$(call packages,--cflags,$(QT)))
$(B)/tests/hosts/ogre_test.cpp.o: private HOST_FLAGS = $(patsubst -I%,-isystem %,$(call packages,--cflags,OGRE)) \
  -fexceptions -frtti -DHAIR_OGRE_PLUGINS='"$(call packages,--variable=plugindir,OGRE)"'
$(B)/tests/hosts/vulkan_test.cpp.o: private HOST_FLAGS = -DHAIR_BUILD_DIR='"$(B)"'
$(B)/tests/hosts/%.cpp.o: tests/hosts/%.cpp
	@mkdir -p $(@D)
	$(call say,$@)
	$(Q)$(CPP) -fPIC $(HOST_FLAGS) -c $< -o $@
$(B)/tests/hosts/qt_test: $(B)/tests/hosts/qt_test.cpp.o $(B)/libhair.a
	$(call say,$@)
	$(Q)$(CXX) $(opt.$(config)) $^ $(call packages,--libs,cmocka $(QT)) -lm -o $@
$(B)/tests/hosts/ogre_test: $(B)/tests/hosts/ogre_test.cpp.o $(B)/libhair.a
	$(call say,$@)
	$(Q)$(CXX) $(opt.$(config)) $^ $(call packages,--libs,cmocka OGRE gl) -lm -o $@

# This test runs an example, whose picture it checks.
$(B)/tests/hosts/vulkan_test: $(B)/tests/hosts/vulkan_test.cpp.o | $(B)/examples/vulkan_host
	$(call say,$@)
	$(Q)$(CXX) $(opt.$(config)) $^ $(call packages,--libs,cmocka) -o $@

$(B)/tests/unit/bullet_%_test: $(B)/tests/unit/bullet_%_test.cpp.o $(SUPPORT) $(B)/libhair_bullet.a $(B)/libhair_egl.a $(B)/libhair.a
	$(call say,$@)
	$(Q)$(CXX) $(opt.$(config)) $(TEST_LINK) $^ -lBulletDynamics $(BULLET_LIBS) $(TEST_LIBS) -o $@

# Run as many tests at once as there are cores, the longest first. tests/README.md has their times.
LONG := bench rod_limits determinism soak threads rod_stress lod instance list character memory capture lengths occlusion golden capture_bullet \
  capture_output bench_cases gallery state save_hostile rod_any rod_heap isolines hair_grid paths \
  precompile rod_contact rod_pins examples rod_two body save rod_whip rod_shape contained rod_bodies \
  instance_far air host_capture accepted random_lists
LONG := $(foreach n,$(LONG),$(filter %/$(n)_test,$(TESTS)))
# Programs that compile many shaders and run each of them briefly. llvmpipe compiles these without
# optimization, with equal results.
BRIEF := batch body budget capture contacts determinism group_style list outputs porous raster refused \
  report rod_pins save scalp sleep state
run-tests: $(TESTS)
	@rm -f $(B)/failed; printf '%s\n' $(filter $(STAGE),$(LONG)) $(filter-out $(LONG),$(STAGE)) | grep -F -- '$(filter)' | \
	  xargs -r -n 1 -P $(JOBS) sh -c 'start=$$(date +%s); [ $$start -lt $(until) ] || { echo "== $$0 left out, because it is late"; exit 0; }; \
	    case " $(BRIEF) " in *" $$(basename "$$0" _test) "*) export GALLIVM_PERF=$${GALLIVM_PERF-nopt};; esac; \
	    said=$$(HAIR_TEST=required "$$0" 2>&1) || echo "$$0" >>$(B)/failed; \
	    printf "== %s, %d s\n%s\n" "$$0" $$(($$(date +%s) - start)) "$$said"'; \
	  [ ! -e $(B)/failed ] || { echo "failed:" $$(cat $(B)/failed); exit 1; }

include tests/fuzz/fuzz.mk

VARIANTS := $(B)/glsl
glsl: ## Compile every shader offline, without a GPU
	@rm -rf $(VARIANTS) && mkdir -p $(VARIANTS)
	@{ { printf '#define FEATURE(name, define) @define name;\n#define TEXT(x) #x\n' ; \
	     printf '#define PASS(name, label, category, features, stages) TEXT((features)) stages;\n#include "lib/gl/passes.inl"\n'; } | \
	     $(CC) -E -P -I. -x c - | tr -d '\n' | tr ';' '\n' | awk -f tools/programs.awk; \
	   printf '%s\n' glsl/gl/driver_quirks.tesc glsl/gl/driver_quirks.tese '-DHAIR_USER_VERTICES=1 glsl/draw/strand.vert' \
	     '-DHAIR_FIBRES=1 -DHAIR_USER_PIXELS=1 glsl/draw/strand.frag'; } | sort -u | \
	  awk -v folder=$(VARIANTS) -f tools/variants.awk >$(VARIANTS)/names
	@cd $(VARIANTS) && xargs -n 50 -P $(JOBS) glslc -c --target-env=opengl4.5 --target-spv=spv1.3 -Werror -fauto-map-locations \
	  -DHAIR_LINES_LEVEL=0 -I$(CURDIR)/glsl <names

check: rooms circles commands symbols hardened comments lines functions words arrays loops mutations amalgam port-version formatted ## Check the order of folders, circles of files, exported names, the one file of all and style
rooms:
	@awk -v order="$(ROOMS)" ' \
	  BEGIN { n = split(order, r, " "); for (i = 1; i <= n; i++) rank[r[i]] = i } \
	  match($$0, /#include "lib\/[a-z]+\//) { split(FILENAME, f, "/"); split($$0, q, "/"); \
	    if (!rank[q[2]] || rank[q[2]] > rank[f[2]]) { print FILENAME ":" FNR ": " f[2] " must not see " q[2]; bad = 1 } } \
	  END { exit bad }' $(wildcard $(ROOMS:%=lib/%/*.[ch]))
# Commands that lists of instances record have functions in lib/gl/commands.h.
RECORDED := BindBuffers(Base|Range)|BindTextureUnit|BindSampler|BindImageTexture|CopyNamedBufferSubData|\
ClearNamedBufferData|MemoryBarrier|UseProgram|DispatchCompute
empty :=
commands:
	@! grep -nE 'gl->($(subst $(empty) ,,$(RECORDED)))\(' $(wildcard $(filter-out lib/gl/%,$(ROOMS:%=lib/%/*.[ch])))
# The files of one folder call each other in one direction only.
circles: $(LIB)
	@nm -A $(filter $(B)/lib/%,$(LIB)) | awk -f tools/circles.awk
symbols: $(LIBRARIES)
	@nm -D --defined-only $(filter %.so,$(LIBRARIES)) | awk 'NF == 3 {print $$3}' | LC_ALL=C sort >$(B)/symbols.txt
	@$(if $(filter 0,$(BULLET)),grep -v hair_bullet_,cat) tests/symbols.txt | diff - $(B)/symbols.txt
	@! objdump -t $(B)/libhair.a | grep -E ' O (\.t?bss|\.t?data|\*COM\*)' | grep -vE '\.data\.rel\.ro|asan|ubsan|gcov' || \
	  { echo "libhair has writable globals (above)"; exit 1; }
	@! nm -u $(filter %.a,$(LIBRARIES)) | grep -wE 'exit|_exit|abort|printf|puts|putchar|fprintf|fputs|fwrite|perror' || { echo "the libraries call these (above)"; exit 1; }

hardened: $(LIBRARIES) $(TOOLS)
	@[ "$(config)" != release ] || sh tools/check/hardened.sh $(filter %.so,$(LIBRARIES)) $(TOOLS)

consumer: install-tree amalgam ## Build and run tests/consumer out of an installed tree and with hair.c
	@CC="$(CC)" CXX="$(CXX)" OPT="$(opt.$(config))" AMALGAM=$(AMALGAM) \
	  sh tests/consumer/run.sh $(abspath $(B))/installed $(abspath $(B))/consumer
install-tree: libraries tools
	@rm -rf $(B)/installed && $(MAKE) install DESTDIR=$(abspath $(B))/installed PREFIX=/usr >/dev/null

TEXTS := lib/*/*.[ch] lib/*/*.cpp lib/*/*.inl include/hair/*.h tools/*.[ch] tools/*.inl tools/*/*.[ch] tools/*/*.cpp \
  tests/*/*.[ch] tests/*/*.cpp
TEXTS := $(wildcard $(TEXTS)) $(GLSL)
comments:
	@LC_ALL=C awk -f tools/check/comments.awk $(TEXTS)
lines:
	@LC_ALL=C awk -f tools/check/lines.awk $(TEXTS)
functions:
	@awk -f tools/check/functions.awk $(filter lib/%.c lib/%.cpp tools/%.c tools/%.cpp,$(TEXTS))
words:
	@awk -f tools/check/words.awk $(filter lib/% glsl/%,$(TEXTS))

loops:
	@LC_ALL=C awk -f tools/check/loops.awk tools/check/loops.txt $(filter-out %.h,$(GLSL))
arrays:
	@awk -f tools/check/arrays.awk $(wildcard glsl/shared/*.h)

SOURCES = $$(git ls-files -co --exclude-standard '*.c' '*.h' '*.cpp' | grep -v '^glsl/')
# A machine without clang-format-14 skips this check.
formatted:
	@! command -v clang-format-14 >/dev/null || clang-format-14 --dry-run -Werror $(SOURCES)
format: ## clang-format everything
	clang-format-14 -i $(SOURCES)
help: ## This list
	@awk -F':.*## ' '/^# make/{print substr($$0, 3)} /^[a-z-]+:.*## /{printf "  %-10s %s\n", $$1, $$2}' Makefile
clean: ## Remove build/
	rm -rf build

include tests/gates.mk
include tools/convert/convert.mk
include tools/truth/truth.mk
include tools/packaging/packaging.mk
include tools/python/python.mk
include tools/packaging/windows.mk

-include $(shell find $(B) -name '*.d' 2>/dev/null)
.DELETE_ON_ERROR:
.SECONDARY:
.PHONY: all hosts view view-film bench report docs libraries tools examples demo gallery test setup run-tests glsl check rooms circles symbols hardened comments lines functions words arrays loops formatted consumer install-tree format help clean
