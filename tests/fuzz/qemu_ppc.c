// qemu_ppc.c - an instruction that qemu-ppc 7.2 lacks, for the replay on PowerPC.
//
// sin() and cos() of the C library begin with mffscrn, which older processors run as mffs. qemu
// refuses it. The signal handler does what mffs does at rounding to nearest: it reads a 0.
#define _GNU_SOURCE
#include <signal.h>
#include <stdint.h>
#include <stdlib.h>
#include <ucontext.h>

#define NIP 32 // Index of the address of the instruction.

static void step_over(int number, siginfo_t* info, void* memory)
{
    ucontext_t* context = memory;
    (void)number;
    (void)info;
    unsigned long* address = &context->uc_mcontext.uc_regs->gregs[NIP];
    uint32_t code = *(const uint32_t*)*address;
    // The fields of the target and of the source register may hold anything.
    if ((code & 0xfc1e07ff) != 0xfc16048e) abort();
    context->uc_mcontext.uc_regs->fpregs.fpregs[code >> 21 & 31] = 0;
    *address += 4;
}

static void __attribute__((constructor)) catch_illegal(void)
{
    struct sigaction action = {.sa_sigaction = step_over, .sa_flags = SA_SIGINFO};
    sigaction(SIGILL, &action, NULL);
}
