// C++ exceptions in WebAssembly. Debian's C++ library for WebAssembly is compiled without exceptions, so it lacks the
// functions that `throw` and `catch` call. The functions here follow the Itanium C++ ABI as clang emits it with
// -fwasm-exceptions: the engine unwinds the stack and calls _Unwind_CallPersonality, which finds the handler in the
// tables of the function.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <new>
#include <typeinfo>

namespace __cxxabiv1 {

/// Layout of libc++abi's private_typeinfo.h, whose objects these are. The order of the virtual functions matters.
class __shim_type_info : public std::type_info {
 public:
  virtual ~__shim_type_info();
  virtual void noop1() const;
  virtual void noop2() const;
  virtual bool can_catch(const __shim_type_info* thrown_type, void*& adjusted) const = 0;
};

}  // namespace __cxxabiv1

namespace {

using TypeInfo = __cxxabiv1::__shim_type_info;

/// Header in front of each thrown object.
struct alignas(16) Thrown {
  const TypeInfo* type = nullptr;
  void* (*destroy)(void*) = nullptr;  ///< a destructor returns its object in WebAssembly
  void* adjusted = nullptr;           ///< the object, converted to the type that is caught
  int handlers = 0;                   ///< number of handlers that are active for it
  bool is_rethrown = false;
  Thrown* next_caught = nullptr;
};

Thrown* caught = nullptr;  ///< the innermost caught exception
unsigned uncaught = 0;

Thrown* header_of(void* object) {
  return static_cast<Thrown*>(object) - 1;
}
void* object_of(Thrown* thrown) {
  return thrown + 1;
}

[[noreturn]] void raise(Thrown* thrown) {
  ++uncaught;
  __builtin_wasm_throw(0, object_of(thrown));
}

void release(Thrown* thrown) {
  if (thrown->destroy) thrown->destroy(object_of(thrown));
  std::free(thrown);
}

std::uintptr_t unsigned_at(const std::uint8_t*& at) {
  std::uintptr_t value = 0;
  for (unsigned shift = 0;; shift += 7) {
    const std::uint8_t byte = *at++;
    value |= static_cast<std::uintptr_t>(byte & 0x7f) << shift;
    if (byte < 0x80) return value;
  }
}

std::intptr_t signed_at(const std::uint8_t*& at) {
  std::intptr_t value = 0;
  for (unsigned shift = 0;;) {
    const std::uint8_t byte = *at++;
    value |= static_cast<std::intptr_t>(byte & 0x7f) << shift;
    shift += 7;
    if (byte >= 0x80) continue;
    if ((byte & 0x40) != 0 && shift < 32) value |= -(std::intptr_t{1} << shift);
    return value;
  }
}

/// Table of a function: the actions of its calls, and the types that it catches.
struct Table {
  const std::uint8_t* calls = nullptr;
  const std::uint8_t* actions = nullptr;
  const TypeInfo* const* types_end = nullptr;  ///< type i is the i-th entry before this

  explicit Table(const std::uint8_t* at) {
    constexpr std::uint8_t kOmitted = 0xff;
    ++at;  // start of landing pads: always omitted
    if (*at++ != kOmitted) {
      const std::uintptr_t offset = unsigned_at(at);
      types_end = reinterpret_cast<const TypeInfo* const*>(at + offset);
    }
    ++at;  // encoding of the calls: always ULEB128
    const std::uintptr_t length = unsigned_at(at);
    calls = at;
    actions = at + length;
  }

  /// Returns the first action of a call, or null if it has none.
  const std::uint8_t* action_of(std::uintptr_t call) const {
    const std::uint8_t* at = calls;
    for (std::uintptr_t i = 0;; ++i) {
      unsigned_at(at);
      const std::uintptr_t entry = unsigned_at(at);
      if (i == call) return entry == 0 ? nullptr : actions + entry - 1;
    }
  }
};

/// Returns the number of the handler of a call that catches the exception, or 0.
int handler_for(Thrown* thrown, const Table& table, std::uintptr_t call) {
  for (const std::uint8_t* action = table.action_of(call); action;) {
    const std::intptr_t type = signed_at(action);
    thrown->adjusted = object_of(thrown);
    if (type > 0) {
      const TypeInfo* const catches = table.types_end[-type];
      if (!catches || catches->can_catch(thrown->type, thrown->adjusted)) return static_cast<int>(type);
    }
    const std::uint8_t* const here = action;
    const std::intptr_t next = signed_at(action);
    if (next == 0) return 0;
    action = here + next;
  }
  return 0;
}

}  // namespace

extern "C" {

/// Data that clang's code passes to _Unwind_CallPersonality and reads back.
struct {
  std::uintptr_t call;
  const std::uint8_t* table;
  std::uintptr_t handler;
} __wasm_lpad_context;

int _Unwind_CallPersonality(void* object) {
  auto& context = __wasm_lpad_context;
  context.handler = static_cast<std::uintptr_t>(handler_for(header_of(object), Table(context.table), context.call));
  return 0;
}

int __gxx_personality_wasm0(...) {
  return 0;
}

void* __cxa_allocate_exception(std::size_t size) noexcept {
  void* const memory = std::malloc(sizeof(Thrown) + size);
  if (!memory) std::abort();
  return object_of(new (memory) Thrown);
}

void __cxa_free_exception(void* object) noexcept {
  std::free(header_of(object));
}

void __cxa_throw(void* object, std::type_info* type, void* (*destroy)(void*)) {
  Thrown* const thrown = header_of(object);
  thrown->type = static_cast<const TypeInfo*>(type);
  thrown->destroy = destroy;
  raise(thrown);
}

void* __cxa_get_exception_ptr(void* object) noexcept {
  return header_of(object)->adjusted;
}

void* __cxa_begin_catch(void* object) noexcept {
  Thrown* const thrown = header_of(object);
  if (thrown->handlers++ == 0 && thrown != caught) {
    thrown->next_caught = caught;
    caught = thrown;
  }
  thrown->is_rethrown = false;
  --uncaught;
  return thrown->adjusted;
}

void __cxa_end_catch() {
  Thrown* const thrown = caught;
  if (!thrown || --thrown->handlers > 0) return;
  caught = thrown->next_caught;
  if (!thrown->is_rethrown) release(thrown);
}

void __cxa_rethrow() {
  if (!caught) std::terminate();
  caught->is_rethrown = true;
  raise(caught);
}

void _Unwind_DeleteException(void*) {}

}  // extern "C"

// Allocation that fails throws, as in a native program. The library's own operator would end the program.
void* operator new(std::size_t size) {
  if (void* const memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
void* operator new[](std::size_t size) {
  return operator new(size);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto to = static_cast<std::size_t>(alignment);
  if (void* const memory = std::aligned_alloc(to, (size + to - 1) / to * to)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
