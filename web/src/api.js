// SPDX-License-Identifier: GPL-3.0-or-later
// The server's interface (docs/reference/serve.md): one function for a request, one for a stream of
// requests of which only the latest counts.

let token = null;

export class ApiError extends Error {
    constructor(status, message, body) {
        super(message);
        this.status = status; // 0: no answer at all
        this.body = body;
    }
    /** The session is gone (401, 403) or the server is (0). */
    get lost() {
        return this.status === 0 || this.status === 401 || this.status === 403;
    }
}

const listeners = new Set();
/** Calls back with the ApiError when the server or the session is gone, with null when it answers again. */
export const onConnection = (f) => listeners.add(f);
const tell = (error) => listeners.forEach((f) => f(error));

export async function request(method, path, body, { signal, as = "json" } = {}) {
    const headers = {};
    if (method !== "GET") headers["X-Flexwright-Token"] = token ?? "";
    if (body !== undefined) headers["Content-Type"] = "application/json";
    let response;
    try {
        response = await fetch(path, {
            method, headers, signal,
            body: body === undefined ? undefined : JSON.stringify(body),
            credentials: "same-origin", cache: "no-store", redirect: "error",
        });
    } catch (error) {
        if (signal?.aborted) throw error;
        const lost = new ApiError(0, "the server does not answer");
        tell(lost);
        throw lost;
    }
    if (!response.ok) {
        let answer = null;
        try {
            answer = await response.json();
        } catch {
            // an answer without JSON is told by its status
        }
        const error = new ApiError(response.status, answer?.error?.message ?? `status ${response.status}`, answer);
        if (error.lost) tell(error);
        throw error;
    }
    tell(null);
    if (as === "text") return response.text();
    if (response.status === 204) return null;
    return response.json();
}

export const get = (path, options) => request("GET", path, undefined, options);
export const post = (path, body, options) => request("POST", path, body, options);
export const remove = (path) => request("DELETE", path);

export async function openSession() {
    const session = await get("/api/session");
    token = session.token;
    return session;
}

/**
 * Latest wins: at most one request is on its way and one waits; a newer one takes the waiting one's
 * place. send(input) makes the request, done(answer, input) gets what came back, failed(error, input)
 * what did not.
 */
export function latest(send, done, failed) {
    let busy = false;
    let waiting;
    async function run(input) {
        busy = true;
        try {
            done(await send(input), input);
        } catch (error) {
            failed(error, input);
        }
        busy = false;
        if (waiting !== undefined) {
            const next = waiting;
            waiting = undefined;
            run(next);
        }
    }
    return (input) => {
        if (busy) waiting = input;
        else run(input);
    };
}
