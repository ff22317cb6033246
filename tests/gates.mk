# Gates that are slower than `make test`, or that need further tools. tests/README.md lists them.

# Static analysis ------------------------------------------------------------------------------------------

# The checker of uninitialized values of gcc 12 takes arrays that loops fill for empty ones. clang-tidy and
# valgrind look for such values instead.
ANALYZED = $(filter-out $(if $(filter 1,$(hosts)),,tools/examples/vulkan_host.c),$(wildcard $(ROOMS:%=lib/%/*.c) lib/egl/*.c \
  tools/*.c tools/*/*.c))
ANALYZE_FLAGS = -std=c17 -Iinclude -I. -I$(B)/tools/examples $(TOOL_CFLAGS) $(call packages,--cflags,sdl2)
analyze: $(if $(filter 1,$(hosts)),$(VULKAN_SHADERS)) analyze-gcc analyze-amalgam analyze-tidy analyze-cppcheck ## Static analysis of lib/ and tools/ by gcc, clang-tidy and cppcheck
analyze-gcc:
	@printf '%s\n' $(ANALYZED) | xargs -P $(JOBS) -I{} gcc $(ANALYZE_FLAGS) -O1 -Werror -Wno-psabi -fanalyzer \
	  -Wno-analyzer-use-of-uninitialized-value -c {} -o /dev/null
# Other checks of the compilers work only with optimization.
analyze-amalgam: amalgam
	@printf '%s\n' 'gcc -O1' 'gcc -O2' 'gcc -O3' 'gcc -Os' 'clang-14 -O2' | xargs -P $(JOBS) -I{} sh -c \
	  '{} -std=c17 -Wall -Wextra -Wno-psabi -Werror -I$(AMALGAM) -c $(AMALGAM)/hair.c -o /dev/null'
analyze-tidy:
	@printf '%s\n' $(ANALYZED) | xargs -P $(JOBS) -I{} sh -c \
	  'said=$$(clang-tidy-14 --quiet {} -- $(ANALYZE_FLAGS) 2>&1) || { echo "$$said"; exit 1; }'
analyze-cppcheck:
	@cppcheck -q -j $(JOBS) --std=c11 --enable=warning,performance,portability --error-exitcode=1 \
	  --suppressions-list=tests/gates/cppcheck.txt -Iinclude -I. -D__linux__ -DHAIR_BUILD_SHARED \
	  $(if $(filter 1,$(hosts)),-I$(B)/tools/examples,-i tools/examples/vulkan_host.c) \
	  $(ROOMS:%=lib/%) lib/egl tools

clang: ## Build everything with clang, with all warnings, in build/clang
	@$(MAKE) -j$(JOBS) config=clang CC=clang-14 CXX=clang++-14 SETUP=0 all examples tests
tests: $(TESTS)

# The files that need no OpenGL, for a CPU of 32 bits.
BARE := $(filter-out $(shell grep -l 'lib/gl/\|epoxy' $(wildcard lib/*/*.c)),$(wildcard $(ROOMS:%=lib/%/*.c)))
test32: ## Compile what needs no OpenGL for 32 bits, without warnings
	@printf '%s\n' $(BARE) | xargs -P $(JOBS) -I{} $(CC) -std=c17 $(WARN) -Wmissing-prototypes -m32 -msse2 -mfpmath=sse \
	  -O2 -Iinclude -I. -c {} -o /dev/null

.PHONY: analyze analyze-gcc analyze-amalgam analyze-tidy analyze-cppcheck clang tests test32

# Supply ---------------------------------------------------------------------------------------------------

# Copies of the source without .git have the date of the changes.
DATE = $(shell TZ=UTC git log -1 --format=%cd --date=format-local:%Y-%m-%dT%H:%M:%SZ 2>/dev/null || date -u -r include/hair/CHANGELOG.md +%FT%TZ)
sbom: $(B)/hair.spdx.json ## build/release/hair.spdx.json: what libraries and tools are made of, in SPDX
$(B)/hair.spdx.json: $(LIBRARIES) $(TOOLS) tools/check/sbom.sh tools/check/licences.txt
	@sh tools/check/sbom.sh $(VERSION) $(DATE) $(filter %.so,$(LIBRARIES)) $(TOOLS) >$@

# Binary interface of the version in tests/abi/version. Added functions are no change of it.
ABIDW := abidw --no-show-locs --no-corpus-path --no-comp-dir-path --drop-private-types --exported-interfaces-only \
  --no-write-default-sizes --no-elf-needed --headers-dir include/hair
abi: $(LIBRARIES) ## Compare the binary interface with that of tests/abi, which must not change within a version
	@if [ "$(VERSION)" != "$$(cat tests/abi/version)" ]; then \
	  echo "tests/abi is of version $$(cat tests/abi/version), not $(VERSION): run make abi-bless when $(VERSION) is complete"; \
	else for n in $(NAMES); do \
	  $(ABIDW) --out-file $(B)/lib$$n.abi $(B)/lib$$n.so && \
	  abidiff --no-added-syms tests/abi/lib$$n.abi $(B)/lib$$n.abi || exit 1; done; fi
abi-bless: $(LIBRARIES) ## Write the binary interface to tests/abi
	@mkdir -p tests/abi && echo $(VERSION) >tests/abi/version
	@for n in $(NAMES); do $(ABIDW) --out-file tests/abi/lib$$n.abi $(B)/lib$$n.so || exit 1; done

reproducible: ## Build libraries and tools twice, in different surroundings, and compare the bytes
	@sh tools/check/reproducible.sh $(abspath build)/reproducible all
.PHONY: sbom abi abi-bless reproducible

# Runs ---------------------------------------------------------------------------------------------------------

# The leak check of GCC before 14 reads the bytes before some thread-local storage of glibc as a header,
# and crashes (https://github.com/google/sanitizers/issues/1322). Without this interceptor, it does not.
ifeq ($(config),asan)
export ASAN_OPTIONS ?= intercept_tls_get_addr=0
endif
ifeq ($(config),tsan)
export TSAN_OPTIONS := suppressions=tests/gates/tsan.txt
endif

# Programs of `make test-full` only. Another program of each subject is in the first stage. A filter selects
# among all programs.
FULL := accepted air_draw attribute_look attribute_physics barrier bench bench_cases bench_fuzz \
  capture_attributes capture_bullet capture_character capture_cut capture_output character contacts \
  contained context_loss context_restore curl_look cut_pieces depth_shadow dispatch divided_draws \
  errors_range examples first_head follower_hit gallery group_look group_physics hair_body hair_body_loss \
  hair_body_step hair_grid host_capture instance instance_far isolines lengths list list_refused lives lod \
  memory occlusion orphan outputs paths porous precompile random_calls random_lists rod_any rod_bodies \
  rod_contact rod_heap rod_limits rod_motion rod_pins rod_shape rod_stress rod_two rod_whip save_hostile \
  saved sdl shadow_range soak solver_stats step_failure tasks threads torture_draw torture_step \
  view_character view_debug view_errors view_memory view_minute view_settings wind wind_coupling
SECOND = $(filter $(foreach n,$(FULL),$(B)/tests/golden/$(n)_test $(B)/tests/gpu/$(n)_test $(B)/tests/hosts/$(n)_test $(B)/tests/unit/$(n)_test $(B)/tests/view/$(n)_test),$(TESTS))
STAGE = $(if $(HAIR_TEST_FULL)$(filter),$(TESTS),$(filter-out $(SECOND),$(TESTS)))
test-second: ## The programs that only test-full runs, with short cases; until=SECONDS starts none later than that time of `date +%s`
	@$(MAKE) run-tests STAGE='$(SECOND)'
test-full: setup ## Every test, with the long cases of each
	@HAIR_TEST_FULL=1 $(MAKE) SETUP=0 test

steps ?= 1000000
soak: $(B)/tests/gpu/soak_test ## Heads that live, die and change for steps=1000000 steps
	HAIR_TEST=required $< $(steps)

# Programs that call no OpenGL and run no tool.
PURE := $(filter-out %/egl_test,$(patsubst %.c,$(B)/%,$(shell grep -L 'HAIR_BUILD_DIR\|shell.h\|support/support.h\|egl' \
  $(wildcard tests/unit/*_test.c))))
valgrind: $(PURE) ## The programs of tests/unit that need no OpenGL, under valgrind
	@printf '%s\n' $(PURE) | xargs -P $(JOBS) -I{} sh -c 'said=$$(HAIR_TEST_SLOW=1 valgrind -q --error-exitcode=1 --leak-check=full {} 2>&1) || \
	  { echo "== {}"; echo "$$said"; exit 1; }'
.PHONY: soak valgrind test-full test-second

# Mesa's zink over lavapipe: the same OpenGL by way of Vulkan.
zink: ## tests/gpu and tests/golden by zink over lavapipe; filter=draw selects programs
	@$(MAKE) -j$(JOBS) SETUP=0 all examples tests
	@MESA_LOADER_DRIVER_OVERRIDE=zink LIBGL_ALWAYS_SOFTWARE=1 VK_ICD_FILENAMES=$(firstword \
	  $(wildcard /usr/share/vulkan/icd.d/lvp_icd*.json)) $(MAKE) SETUP=0 run-tests TESTS='$(filter $(B)/tests/g%,$(TESTS))'
.PHONY: zink

# Tests of the tests. `make check` checks only that the table of bugs fits the source.
mutation: ## Seed bugs in a copy of the source, and check that tests find each of them; only=NAME seeds one
	@nice python3 -B tests/mutation/mutate.py $(only)
mutations:
	@python3 -B tests/mutation/mutate.py --check
.PHONY: mutation mutations
