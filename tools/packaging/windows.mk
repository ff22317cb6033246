# windows.mk - hair.dll by a cross compiler, and the tests that need no OpenGL under Wine.
#
#   make CC=x86_64-w64-mingw32-gcc
#   make CC=x86_64-w64-mingw32-gcc CXX=x86_64-w64-mingw32-g++ test-windows

ifneq ($(WINDOWS),)
$(B)/hair.dll: $(LIB:.o=.shared.o)
	$(call say,$@)
	$(Q)$(CC) -shared -static-libgcc $(opt.$(config)) -Wl,--out-implib,$(B)/hair.lib $^ -lm -o $@
endif

# The framework of the tests is made from the source package of the system, because there is no package for MinGW.
CMOCKA := build/windows-cmocka
$(CMOCKA)/cmocka.o:
	@CC="$(CC)" sh tools/packaging/windows_cmocka.sh $(abspath $(CMOCKA))

# Tests that call no OpenGL, and nothing of tools or of an operating system.
WINDOWS_TESTS   = $(patsubst $(B)/%,%.c,$(filter-out $(shell grep -l '"tools/\|unistd\|sys/\|pthread\|locale.h\|timespec_get\|reference\|tests/fuzz' \
  $(wildcard tests/unit/*_test.c) | sed 's|\(.*\)\.c|$(B)/\1|'),$(PURE)))
WINDOWS_SUPPORT := $(patsubst %,tests/support/%.c,cut files groomfile grooms handmade heads host meshes seal)
$(B)/support.a: $(WINDOWS_SUPPORT:%=$(B)/%.o)
$(B)/wine/%.exe: $(B)/tests/unit/%.c.o $(B)/support.a $(B)/libhair.a $(CMOCKA)/cmocka.o
	@mkdir -p $(@D)
	$(call say,$@)
	$(Q)$(CXX) -static $^ -lm -o $@

$(B)/wine/groom.exe: tests/consumer/groom.c $(B)/hair.dll
	@mkdir -p $(@D) && cp $(B)/hair.dll $(@D)
	$(Q)$(CC) -std=c99 -pedantic -Wall -Wextra -Werror -DHAIR_SHARED -Iinclude $< $(B)/hair.lib -o $@

test-windows: $(B)/wine/groom.exe ## The tests that need no OpenGL, for Windows under Wine; set CC and CXX to those of MinGW
	@$(MAKE) $(CMOCKA)/cmocka.o
	@$(MAKE) -j$(JOBS) CFLAGS=-I$(abspath $(CMOCKA))/include $(patsubst tests/unit/%.c,$(B)/wine/%.exe,$(WINDOWS_TESTS))
	@for test in $(patsubst tests/unit/%.c,$(B)/wine/%.exe,$(WINDOWS_TESTS)); do \
	  WINEDEBUG=-all WINEPREFIX=$(abspath build/wine) wine $$test || { echo "failed: $$test"; exit 1; }; done
	@said=$$(WINEDEBUG=-all WINEPREFIX=$(abspath build/wine) wine $(B)/wine/groom.exe | tr -d '\r'); \
	  [ "$$said" = "166 guides, 18000 followers" ] || { echo "groom.exe with hair.dll printed \"$$said\""; exit 1; }

.PHONY: test-windows
