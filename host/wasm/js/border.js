// Opening a module of WebAssembly: numbers, lists and messages out of it.

/** Compiles a module, given as base64. */
export function compile(encoded) {
    return new WebAssembly.Module(Uint8Array.from(atob(encoded), (letter) => letter.charCodeAt(0)));
}

/** Opens a module, with memory of its own. */
export function open(module) {
    const engine = new WebAssembly.Instance(module).exports;

    /** The message of the call that failed. */
    function message() {
        const text = new Uint8Array(engine.memory.buffer, engine.message(), engine.message_length());
        return new TextDecoder().decode(text);
    }

    /** The number that a call returned, or an exception. Lists stay until `lists` or `forget` is called. */
    function checked(result) {
        if (result !== -2) return result;
        const text = message();
        engine.forget();
        throw new RangeError(text);
    }

    /** Copies of the first lists of the last call. The buffers of the module are dropped. */
    function lists(count) {
        const copies = [];
        for (let number = 0; number < count; number++) {
            const length = engine.list_length(number);
            copies.push(new Uint32Array(engine.memory.buffer, engine.list(number), length).slice());
        }
        engine.forget();
        return copies;
    }

    return {engine, checked, lists};
}
