# make fuzz             fuzz every parser for a minute; seconds=600 for ten, runs=1000000 for so many runs,
#                       parser=obj for one of them, sanitizer=memory with MemorySanitizer
# make fuzz-coverage    the lines of the parsers that the corpus runs
# make fuzz-merge       add to the corpus what `make fuzz` found to run more of the code
# make corpora          files of public projects, whole, cut off and with flipped bits
# make fuzz-static      build/fuzz-static, a folder with programs to carry to another machine
# make fuzz-portable    the corpus on x86-64, in 32 bits, and on big-endian PowerPC under qemu, compared
comma     := ,
seconds   ?= 60
runs      ?= -1
sanitizer ?= address

# Programs, and objects of the tools that each needs. The rest comes out of the library.
FUZZERS := hairfile groomfile tfx tfx_text obj save members groom_arguments bench_arguments scene capture_arguments gltf
FUZZ_SCENE := builtin json motion obj scene scene_bullet scene_character scene_colliders scene_cuts scene_lights scene_maps scene_wind \
  settings settings_keys
FUZZ_GLTF := gltf gltf_animation gltf_buffer gltf_mesh gltf_node
FUZZ_TOOLS.hairfile          := file
FUZZ_TOOLS.groomfile         := file
FUZZ_TOOLS.tfx               := file
FUZZ_TOOLS.tfx_text          := file
FUZZ_TOOLS.obj               := file obj
FUZZ_TOOLS.save              := file
FUZZ_TOOLS.members           := file
FUZZ_TOOLS.groom_arguments   := file groom_options
FUZZ_TOOLS.bench_arguments   := file
FUZZ_TOOLS.scene             := file $(FUZZ_SCENE)
FUZZ_TOOLS.capture_arguments := file $(FUZZ_SCENE) capture_options
FUZZ_TOOLS.gltf              := file json $(FUZZ_GLTF)
# Maximum length of an input in bytes, 1024 by default. Short inputs make many runs per second.
FUZZ_MAX.groomfile         := 1536
FUZZ_MAX.save              := 4096
FUZZ_MAX.scene             := 2048
FUZZ_MAX.groom_arguments   := 256
FUZZ_MAX.bench_arguments   := 256
FUZZ_MAX.capture_arguments := 256
FUZZ_MAX.gltf              := 4096
FUZZ_ALL_TOOLS := file groom_options capture_options $(FUZZ_SCENE) $(FUZZ_GLTF)
# Parsers that need no library which MemorySanitizer has not compiled, as libjansson.
FUZZ_PLAIN := hairfile groomfile tfx tfx_text obj save members groom_arguments bench_arguments
parser    ?= $(if $(filter memory,$(sanitizer)),$(FUZZ_PLAIN),$(FUZZERS))

# Sources of a program, and of the replay of all.
fuzz_sources = tests/fuzz/$(1)_fuzz.c tests/fuzz/fuzz.c tests/fuzz/fuzz_asset.c tests/support/seal.c \
  $(FUZZ_TOOLS.$(1):%=tools/common/%.c) $(if $(filter bench_arguments,$(1)),tools/bench/options.c)
FUZZ_REPLAY := $(FUZZERS:%=tests/fuzz/%_fuzz.c) $(addprefix tests/fuzz/,fuzz.c fuzz_asset.c corpus.c targets.c) tests/support/seal.c
FUZZ_REPLAY += $(FUZZ_ALL_TOOLS:%=tools/common/%.c) tools/bench/options.c
FUZZ_WRAPS := $(addprefix -Wl$(comma)--wrap=,malloc calloc realloc hair_file_read hair_frame_writer_is_picture)

# The replay among the unit tests, which gcc builds.
$(B)/tests/unit/fuzz_corpus_test: $(B)/tests/unit/fuzz_corpus_test.c.o $(FUZZ_REPLAY:%=$(B)/%.o) $(B)/libhair.a
	$(call say,$@)
	$(Q)$(CC) $(opt.$(config)) $(LINK_FLAGS) $(FUZZ_WRAPS) $^ $(TEST_LIBS) -o $@

# Files of other projects ---------------------------------------------------------------------------------------
$(B)/tests/fuzz/replay: $(B)/tests/fuzz/replay.c.o $(FUZZ_REPLAY:%=$(B)/%.o) $(B)/libhair.a
	$(call say,$@)
	$(Q)$(CC) $(opt.$(config)) $(LINK_FLAGS) $(FUZZ_WRAPS) $^ $(TEST_LIBS) -o $@
corpora: $(B)/tests/fuzz/replay $(B)/hair-capture ## Parsers on files of public projects, by git; corpora=FOLDER has clones
	@sh tests/fuzz/corpora.sh $(B) $(corpora)

# Programs of libFuzzer, built by clang from the same sources -----------------------------------------------
FUZZ_DIR := build/fuzz/$(sanitizer)
# The address sanitizer finds what the two checks that are left out would find.
FUZZ_SAN.address  := -fsanitize=address,undefined,float-cast-overflow -fno-sanitize=null,pointer-overflow \
  -fno-sanitize-recover=all
FUZZ_SAN.memory   := -fsanitize=memory -fsanitize-memory-track-origins -fno-sanitize-recover=all
FUZZ_FLAGS := -std=c17 -Iinclude -I. -O2 -g -ffp-contract=off -MMD -MP
FUZZ_LIB   := $(foreach r,$(ROOMS),$(wildcard lib/$(r)/*.c))
FUZZ_LIBS   = $(call packages,--libs,jansson) -lm

fuzz-needs:
	@command -v clang-14 >/dev/null && [ -e /usr/lib/llvm-14/lib/clang/*/lib/linux/libclang_rt.fuzzer-x86_64.a ] || \
	  { echo "make fuzz needs the packages clang-14, libclang-rt-14-dev and llvm-14."; exit 1; }

build/fuzz/address/%.o: %.c | fuzz-needs
	@mkdir -p $(@D)
	$(call say,$@)
	$(Q)clang-14 $(FUZZ_FLAGS) -fsanitize=fuzzer-no-link $(FUZZ_SAN.address) -DHAIR_FUZZ_PROGRAM -c $< -o $@
build/fuzz/memory/%.o: %.c | fuzz-needs
	@mkdir -p $(@D)
	$(call say,$@)
	$(Q)clang-14 $(FUZZ_FLAGS) -fsanitize=fuzzer-no-link $(FUZZ_SAN.memory) -DHAIR_FUZZ_PROGRAM -c $< -o $@
build/fuzz/%/gen/sources.c: $(B)/gen/sources.c
	@mkdir -p $(@D) && cp $< $@
build/fuzz/%/gen/sources.o: build/fuzz/%/gen/sources.c
	$(call say,$@)
	$(Q)clang-14 $(FUZZ_FLAGS) -c $< -o $@
$(FUZZ_DIR)/libhair.a: $(FUZZ_LIB:%.c=$(FUZZ_DIR)/%.o) $(FUZZ_DIR)/gen/sources.o
	@rm -f $@ && $(AR) rcs $@ $^
# Comparisons of distances and hashes tell libFuzzer nothing about the format, and take half of the time.
$(patsubst %,build/fuzz/%.o,$(foreach s,address memory,$(addprefix $(s)/,lib/asset/strand lib/asset/strands \
  lib/asset/colors tests/fuzz/fuzz tests/fuzz/fuzz_asset))): private FUZZ_FLAGS += -fno-sanitize-coverage=trace-cmp
define fuzz_program
$(FUZZ_DIR)/$(1): $(patsubst %.c,$(FUZZ_DIR)/%.o,$(call fuzz_sources,$(1))) $(FUZZ_DIR)/libhair.a
	$$(call say,$$@)
	$$(Q)clang-14 -fsanitize=fuzzer $(FUZZ_SAN.$(sanitizer)) $(FUZZ_WRAPS) $$^ $$(FUZZ_LIBS) -o $$@
endef
$(foreach f,$(FUZZERS),$(eval $(call fuzz_program,$(f))))

# A program adds what it finds to build/fuzz/corpus/PARSER, and begins with the committed inputs.
FUZZ_OPTIONS = -max_len=$(or $(FUZZ_MAX.$(1)),1024) -timeout=10 -rss_limit_mb=1024 -print_final_stats=1 -verbosity=0 \
  -artifact_prefix=build/fuzz/found/$(1)-
fuzz: $(parser:%=$(FUZZ_DIR)/%) ## Fuzz every parser: seconds=60 each, or runs=N; needs clang-14
	@mkdir -p build/fuzz/found $(parser:%=build/fuzz/corpus/%)
	@$(foreach f,$(parser),echo "== $(f)"; $(FUZZ_DIR)/$(f) $(call FUZZ_OPTIONS,$(f)) -runs=$(runs) \
	  $(if $(filter -1,$(runs)),-max_total_time=$(seconds)) build/fuzz/corpus/$(f) tests/fuzz/corpus/$(f) || exit 1;) :

# Keep the committed inputs below 4 KiB, and add only those that run more of the code.
fuzz-merge: $(parser:%=$(FUZZ_DIR)/%)
	@$(foreach f,$(parser),mkdir -p tests/fuzz/corpus/$(f); $(FUZZ_DIR)/$(f) $(call FUZZ_OPTIONS,$(f)) -merge=1 -use_counters=0 \
	  tests/fuzz/corpus/$(f) build/fuzz/corpus/$(f) 2>&1 | tail -1;)

# Coverage -------------------------------------------------------------------------------------------------
FUZZ_COVERED := lib/asset/%.c lib/sim/save_check.c lib/sim/save_fields.c lib/sim/serializer.c lib/api/members%.c tools/common/obj.c \
  tools/common/json.c tools/common/scene.c tools/common/scene_%.c tools/common/settings.c \
  tools/common/settings_keys.c tools/common/groom_options.c tools/common/capture_options.c tools/bench/options.c
build/fuzz/coverage/%.o: %.c | fuzz-needs
	@mkdir -p $(@D)
	$(call say,$@)
	$(Q)clang-14 $(FUZZ_FLAGS) -DNDEBUG -fprofile-instr-generate -fcoverage-mapping -c $< -o $@
build/fuzz/coverage/replay: $(patsubst %.c,build/fuzz/coverage/%.o,$(FUZZ_REPLAY) tests/fuzz/replay.c $(FUZZ_LIB)) \
  build/fuzz/coverage/gen/sources.o
	$(call say,$@)
	$(Q)clang-14 -fprofile-instr-generate $(FUZZ_WRAPS) $^ $(FUZZ_LIBS) -o $@
fuzz-coverage: build/fuzz/coverage/replay ## Lines of the parsers that the corpus of the fuzz programs runs
	@LLVM_PROFILE_FILE=build/fuzz/coverage/replay.raw $< $(if $(corpus),$(corpus),tests/fuzz/corpus)
	@llvm-profdata-14 merge -o build/fuzz/coverage/replay.data build/fuzz/coverage/replay.raw
	@llvm-cov-14 report $< -instr-profile=build/fuzz/coverage/replay.data \
	  $(filter-out lib/asset/arrays.c lib/asset/attributes.c lib/asset/maps.c,$(filter $(FUZZ_COVERED),$(FUZZ_LIB) $(FUZZ_REPLAY))) | \
	  awk '/^[a-z].*\.c|^TOTAL/ {printf "%-36s %5d lines, %4d not run, %s; branches %s\n", $$1, $$8, $$9, $$10, $$13}'

# Programs to carry to another machine -----------------------------------------------------------------------
# They bring the C library and its loader, and run in their folder.
FUZZ_CARRIED := build/fuzz-static
fuzz-static: $(FUZZERS:%=build/fuzz/address/%)
	@rm -rf $(FUZZ_CARRIED) && mkdir -p $(FUZZ_CARRIED)/lib
	@$(foreach f,$(FUZZERS),clang++-14 -fsanitize=fuzzer $(FUZZ_SAN.address) $(FUZZ_WRAPS) -s -static-libstdc++ \
	  -static-libgcc -Wl$(comma)--dynamic-linker=lib/ld-linux-x86-64.so.2 -Wl$(comma)-rpath$(comma)'$$ORIGIN/lib' \
	  $(patsubst %.c,build/fuzz/address/%.o,$(call fuzz_sources,$(f))) build/fuzz/address/libhair.a -l:libjansson.a -lm \
	  -o $(FUZZ_CARRIED)/$(f) || exit 1;)
	@cp -L $$(ldd build/fuzz/address/scene | grep -oE '/[^ ]*/(libc|libm|ld-linux-x86-64)\.so\.[0-9]') $(FUZZ_CARRIED)/lib
	@cp -r tests/fuzz/corpus tests/fuzz/run.sh $(FUZZ_CARRIED)
	@du -sh $(FUZZ_CARRIED)

# Other architectures ------------------------------------------------------------------------------------------
FUZZ_PORTABLE := $(filter-out %scene_fuzz.c %gltf_fuzz.c %capture_arguments_fuzz.c %bench_arguments_fuzz.c tools/bench/%, \
  $(filter tests/%,$(FUZZ_REPLAY))) tools/common/file.c tools/common/obj.c tools/common/groom_options.c
FUZZ_PORTABLE += tests/fuzz/replay.c $(FUZZ_LIB)
FUZZ_PORTABLE_FLAGS := -std=c17 -Iinclude -I. -O1 -g -ffp-contract=off -DHAIR_FUZZ_PORTABLE -D_FILE_OFFSET_BITS=64 -MMD -MP
FUZZ_CC.64  := gcc
FUZZ_CC.32  := gcc -m32 -msse2 -mfpmath=sse -idirafter /usr/include/x86_64-linux-gnu
FUZZ_CC.ppc := powerpc-linux-gnu-gcc-12
FUZZ_RUN.ppc := qemu-ppc -L /usr/powerpc-linux-gnu
FUZZ_MORE.ppc := tests/fuzz/qemu_ppc.c
define fuzz_portable
build/fuzz/$(1)/%.o: %.c
	@mkdir -p $$(@D)
	$$(call say,$$@)
	$$(Q)$(FUZZ_CC.$(1)) $(FUZZ_PORTABLE_FLAGS) -idirafter build/fuzz/headers -c $$< -o $$@
build/fuzz/$(1)/gen/sources.o: $(B)/gen/sources.c
	@mkdir -p $$(@D)
	$$(Q)$(FUZZ_CC.$(1)) $(FUZZ_PORTABLE_FLAGS) -c $$< -o $$@
build/fuzz/$(1)/replay: $(patsubst %.c,build/fuzz/$(1)/%.o,$(FUZZ_PORTABLE) $(FUZZ_MORE.$(1))) build/fuzz/$(1)/gen/sources.o
	$$(call say,$$@)
	$$(Q)$(FUZZ_CC.$(1)) $(FUZZ_WRAPS) $$^ -lm -o $$@
$(patsubst %.c,build/fuzz/$(1)/%.o,$(FUZZ_PORTABLE)): | build/fuzz/headers/GL
endef
$(foreach a,64 32 ppc,$(eval $(call fuzz_portable,$(a))))
# Headers of OpenGL, which are equal for all architectures.
build/fuzz/headers/GL:
	@mkdir -p build/fuzz/headers && cp -rL /usr/include/GL /usr/include/KHR build/fuzz/headers
fuzz-portable: build/fuzz/64/replay build/fuzz/32/replay build/fuzz/ppc/replay ## Replay the corpus in 32 bits and on big-endian PowerPC
	@$(foreach a,64 32 ppc,echo "== $(a)"; $(FUZZ_RUN.$(a)) build/fuzz/$(a)/replay >build/fuzz/$(a)/hashes && cat build/fuzz/$(a)/hashes || exit 1;)
	@cmp build/fuzz/64/hashes build/fuzz/32/hashes && cmp build/fuzz/64/hashes build/fuzz/ppc/hashes && echo "All hashes are equal."

.PHONY: fuzz corpora fuzz-needs fuzz-merge fuzz-coverage fuzz-static fuzz-portable
-include $(shell find build/fuzz -name "*.d" 2>/dev/null)
