# Gates that are slower than `make test`, or that need further tools. tests/README.md lists them.

# Static analysis ------------------------------------------------------------------------------------------

# The checker of uninitialized values of gcc 12 takes arrays that loops fill for empty ones. clang-tidy and
# valgrind look for such values instead.
ANALYZED = $(wildcard $(ROOMS:%=lib/%/*.c) lib/egl/*.c tools/*.c tools/*/*.c)
ANALYZE_FLAGS = -std=c17 -Iinclude -I. $(TOOL_CFLAGS) $(call packages,--cflags,sdl2)
analyze: analyze-gcc analyze-tidy analyze-cppcheck ## Static analysis of lib/ and tools/ by gcc, clang-tidy and cppcheck
analyze-gcc:
	@printf '%s\n' $(ANALYZED) | xargs -P $(JOBS) -I{} gcc $(ANALYZE_FLAGS) -O1 -Werror -fanalyzer \
	  -Wno-analyzer-use-of-uninitialized-value -c {} -o /dev/null
analyze-tidy:
	@printf '%s\n' $(ANALYZED) | xargs -P $(JOBS) -I{} sh -c \
	  'said=$$(clang-tidy-14 --quiet {} -- $(ANALYZE_FLAGS) 2>&1) || { echo "$$said"; exit 1; }'
analyze-cppcheck:
	@cppcheck -q -j $(JOBS) --std=c11 --enable=warning,performance,portability --error-exitcode=1 \
	  --suppressions-list=tests/gates/cppcheck.txt -Iinclude -I. -D__linux__ -DHAIR_BUILD_SHARED \
	  $(ROOMS:%=lib/%) lib/egl tools

clang: ## Build everything with clang, with all warnings, in build/clang
	@$(MAKE) -j$(JOBS) config=clang CC=clang-14 CXX=clang++-14 SETUP=0 all examples tests
tests: $(TESTS)

# The files that need no OpenGL, for a CPU of 32 bits.
BARE := $(filter-out $(shell grep -l 'lib/gl/\|epoxy' $(wildcard lib/*/*.c)),$(wildcard $(ROOMS:%=lib/%/*.c)))
test32: ## Compile what needs no OpenGL for 32 bits, without warnings
	@printf '%s\n' $(BARE) | xargs -P $(JOBS) -I{} $(CC) -std=c17 $(WARN) -Wmissing-prototypes -m32 -msse2 -mfpmath=sse \
	  -O2 -Iinclude -I. -c {} -o /dev/null

.PHONY: analyze analyze-gcc analyze-tidy analyze-cppcheck clang tests test32
