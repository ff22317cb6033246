// interrupt.h - Signals that end a tool, such as Ctrl-C.
#ifndef HAIR_TOOLS_COMMON_INTERRUPT_H
#define HAIR_TOOLS_COMMON_INTERRUPT_H

#include <stdbool.h>

// Let the tool end after the current frame. A frame that takes longer than a second, and a second
// signal, end the program at once, and remove the temporary files of open outputs.
void hair_interrupt_catch(const char* tool);

// Return whether a signal has arrived.
bool hair_interrupted(void);

#endif
