// The layer between a Verilated class and Rust: a plain C table of functions and ports.
// The layout of Port and Description is repeated in src/description.rs.
#pragma once
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include "verilated.h"
#if VM_TRACE
#include "verilated_vcd_c.h"
#endif

namespace verilated_shim {

struct Port {
    const char* name;
    uint32_t width;
    uint32_t direction;  // 0 input, 1 output
};

struct Description {
    const char* name;
    const Port* ports;
    size_t port_count;
    // Seed 0 starts with all state zero, any other with random state.
    void* (*create)(int32_t seed, void** port_addresses);
    void (*destroy)(void*);
    void (*eval)(void*);
    // Null in a model without tracing.
    int32_t (*trace_open)(void*, const char* path);
    void (*trace_dump)(void*, uint64_t time);
    // 0 if something since the trace began could not be written.
    int32_t (*trace_flush)(void*);
    void (*trace_close)(void*);
};

#if VM_TRACE
// A file that remembers a failed write and goes on. The runtime would end the program while it holds a lock for which
// its own exit handlers wait, so that a full disk would hang the program.
class File final : public VerilatedVcdFile {
public:
    bool lost = false;
    ssize_t write(const char* data, ssize_t length) override {
        const ssize_t written = VerilatedVcdFile::write(data, length);
        if (written >= 0 || errno == EAGAIN || errno == EINTR) return written;
        lost = true;
        return length;
    }
};
#endif

// One instance: its own context, so instances share no time, seed or thread.
template <class Verilated_, void (*addresses)(Verilated_&, void**)>
struct Instance {
    VerilatedContext context;
    Verilated_* model = nullptr;
#if VM_TRACE
    File* file = nullptr;
    VerilatedVcdC* trace = nullptr;
#endif

    // The runtime finds the context through a thread-local pointer, which the last instance built has set.
    static Instance& enter(void* self) {
        Instance& instance = *static_cast<Instance*>(self);
        Verilated::threadContextp(&instance.context);
        return instance;
    }

    static void* create(int32_t seed, void** port_addresses) noexcept {
        Instance* instance = new Instance;
        enter(instance);
        instance->context.randReset(seed == 0 ? 0 : 2);
        if (seed != 0) instance->context.randSeed(seed);
#if VM_TRACE
        instance->context.traceEverOn(true);
#endif
        instance->model = new Verilated_(&instance->context, "TOP");
        addresses(*instance->model, port_addresses);
        return instance;
    }

    static void destroy(void* self) noexcept {
        Instance& instance = enter(self);
#if VM_TRACE
        instance.end_trace();
#endif
        instance.model->final();
        delete instance.model;
        delete &instance;
    }

    static void eval(void* self) noexcept { enter(self).model->eval(); }

#if VM_TRACE
    void end_trace() {
        if (!trace) return;
        trace->close();
        delete trace;
        delete file;
        trace = nullptr;
        file = nullptr;
    }

    static int32_t trace_open(void* self, const char* path) noexcept {
        Instance& instance = enter(self);
        // A trace object refuses to go back to a time it has written, so each file gets its own.
        instance.end_trace();
        instance.file = new File;
        instance.trace = new VerilatedVcdC(instance.file);
        instance.model->trace(instance.trace, 99);
        instance.trace->open(path);
        return instance.trace->isOpen() ? 1 : 0;
    }

    static void trace_dump(void* self, uint64_t time) noexcept { enter(self).trace->dump(time); }
    static int32_t trace_flush(void* self) noexcept {
        Instance& instance = enter(self);
        instance.trace->flush();
        return instance.file->lost ? 0 : 1;
    }
    static void trace_close(void* self) noexcept { enter(self).end_trace(); }
#endif

    static constexpr Description describe(const char* name, const Port* ports, size_t port_count) {
        return {name, ports, port_count, create, destroy, eval,
#if VM_TRACE
                trace_open, trace_dump, trace_flush, trace_close
#else
                nullptr, nullptr, nullptr, nullptr
#endif
        };
    }
};

}  // namespace verilated_shim
