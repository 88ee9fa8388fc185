// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "fibre.h"

#include <cstdint>
#include <new>

#if !defined(__x86_64__)
#include <ucontext.h>
#endif
#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/asan_interface.h>
#include <sanitizer/common_interface_defs.h>
#endif

namespace cuda_emulation {
namespace {

#if defined(__SANITIZE_ADDRESS__)
constexpr std::size_t STACK_BYTES = 256 * 1024;
#else
constexpr std::size_t STACK_BYTES = 64 * 1024;
#endif

/** \brief Whose turn it is; the first entry into a fibre has no other argument. */
void* starting = nullptr;

} // namespace

#if defined(__x86_64__)

// swapcontext() asks the system for its signal mask every time; a block's threads change
// places millions of times. This one saves what a call must preserve, and no more.
extern "C" void
cuda_emulation_switch(void** left_stack, void* entered_stack);
asm(R"(
.text
.globl cuda_emulation_switch
.hidden cuda_emulation_switch
.type cuda_emulation_switch,@function
cuda_emulation_switch:
  pushq %rbp
  pushq %rbx
  pushq %r12
  pushq %r13
  pushq %r14
  pushq %r15
  movq %rsp, (%rdi)
  movq %rsi, %rsp
  popq %r15
  popq %r14
  popq %r13
  popq %r12
  popq %rbx
  popq %rbp
  ret
.size cuda_emulation_switch,.-cuda_emulation_switch
)");

namespace {

struct Context {
  void* stack = nullptr;

  void
  prepare(unsigned char* bottom, void (*entry)())
  {
    // Six registers, the address to return to, and one word for the alignment of a call.
    void** top = reinterpret_cast<void**>(bottom + STACK_BYTES) - 8;
    for (int i = 0; i < 8; ++i)
      top[i] = nullptr;
    top[6] = reinterpret_cast<void*>(entry);
    stack = top;
  }
  static void
  change(Context& from, Context& to)
  {
    cuda_emulation_switch(&from.stack, to.stack);
  }
};

} // namespace

#else

namespace {

struct Context {
  ucontext_t context;

  void
  prepare(unsigned char* bottom, void (*entry)())
  {
    getcontext(&context);
    context.uc_stack.ss_sp = bottom;
    context.uc_stack.ss_size = STACK_BYTES;
    context.uc_link = nullptr;
    makecontext(&context, entry, 0);
  }
  static void
  change(Context& from, Context& to)
  {
    swapcontext(&from.context, &to.context);
  }
};

} // namespace

#endif

struct Fibre::Implementation {
  std::unique_ptr<unsigned char[]> stack{new unsigned char[STACK_BYTES]};
  Context inside, outside;
  void (*entry)(void*) = nullptr;
  void* argument = nullptr;
#if defined(__SANITIZE_ADDRESS__)
  void* fake_inside = nullptr;
  void* fake_outside = nullptr;
  const void* outside_bottom = nullptr;
  std::size_t outside_size = 0;
#endif

  // The address sanitizer wants to know which stack is in use, before and after a change.
  void
  enter()
  {
#if defined(__SANITIZE_ADDRESS__)
    __sanitizer_start_switch_fiber(&fake_outside, stack.get(), STACK_BYTES);
#endif
    Context::change(outside, inside);
#if defined(__SANITIZE_ADDRESS__)
    __sanitizer_finish_switch_fiber(fake_outside, nullptr, nullptr);
#endif
  }
  void
  leave()
  {
#if defined(__SANITIZE_ADDRESS__)
    __sanitizer_start_switch_fiber(&fake_inside, outside_bottom, outside_size);
#endif
    Context::change(inside, outside);
    arrived();
  }
  void
  arrived()
  {
#if defined(__SANITIZE_ADDRESS__)
    __sanitizer_finish_switch_fiber(fake_inside, &outside_bottom, &outside_size);
#endif
  }

  static void
  first()
  {
    auto* self = static_cast<Implementation*>(starting);
    self->arrived();
    self->entry(self->argument);
  }
};

Fibre::Fibre() : implementation_(std::make_unique<Implementation>()) {}
Fibre::~Fibre() = default;

void
Fibre::start(void (*entry)(void*), void* argument)
{
  implementation_->entry = entry;
  implementation_->argument = argument;
#if defined(__SANITIZE_ADDRESS__)
  implementation_->fake_inside = nullptr;
  // Functions that were never returned from have left their marks.
  ASAN_UNPOISON_MEMORY_REGION(implementation_->stack.get(), STACK_BYTES);
#endif
  implementation_->inside.prepare(implementation_->stack.get(), &Implementation::first);
}

void
Fibre::resume()
{
  starting = implementation_.get();
  implementation_->enter();
}

void
Fibre::leave()
{
  implementation_->leave();
}

} // namespace cuda_emulation
