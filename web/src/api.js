// SPDX-License-Identifier: GPL-3.0-or-later
// The server's interface (docs/reference/serve.md): one function for a request, one for a stream of
// requests of which only the latest counts.

import { begin, OLD_MS } from "./belong.js";

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

export async function request(method, path, body, { signal, as = "json", quiet = false } = {}) {
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
    if (!quiet) tell(null);
    if (as === "text") return response.text();
    if (response.status === 204) return null;
    return response.json();
}

export const get = (path, options) => request("GET", path, undefined, options);
export const post = (path, body, options) => request("POST", path, body, options);
export const remove = (path) => request("DELETE", path);
/** The same of a page that is going: nobody hears the answer. */
export const removeAndGo = (path) => fetch(path, { method: "DELETE", headers: { "X-Flexwright-Token": token ?? "" }, credentials: "same-origin", keepalive: true }).catch(() => {});

export async function openSession() {
    const session = await get("/api/session", { quiet: true });
    token = session.token;
    tell(null); // whoever goes on now has the token
    return session;
}

/**
 * The newest wins. At most one request is on its way and one waits; a newer one takes the waiting one's place. The one
 * on its way is given up, here and on the server, when a newer one waits and it has taken longer than such a request
 * usually does: so a slider that moves shows every answer that comes in time, and nothing waits behind a slow one.
 *
 * send(input, signal) makes the request; done(answer, input) gets what came back, failed(error, input) what did not,
 * given(input, why) what was given up: "newer" or "cancelled". words: of the sign that it is on its way; null: another request
 * of the same input has one. Returns {ask(input), cancel(), busy, input}.
 */
export function newest(send, done, failed, { given, words = "computing" } = {}) {
    const usual = []; // ms of the last answers
    let now = null; // {input, control, since, why, end, timer}
    let waiting;

    const patience = () => Math.min(Math.max(OLD_MS, 1.5 * median(usual)), PATIENCE_MOST_MS);

    function hurry() {
        if (!now || waiting === undefined) return;
        clearTimeout(now.timer);
        const rest = patience() - (performance.now() - now.since);
        if (rest <= 0) give("newer");
        else now.timer = setTimeout(hurry, rest);
    }

    function give(why) {
        if (!now || now.why) return;
        now.why = why;
        now.control.abort();
    }

    async function run(input, waits = performance.now()) {
        const me = (now = { input, control: new AbortController(), since: performance.now(), why: null });
        const end = words === null ? () => {} : begin({ words, cancel, since: waits });
        try {
            const answer = await send(input, me.control.signal);
            usual.push(performance.now() - me.since);
            if (usual.length > 9) usual.shift();
            if (me.why) given?.(input, me.why);
            else done(answer, input);
        } catch (error) {
            if (me.why) given?.(input, me.why);
            else failed(error, input);
        } finally {
            clearTimeout(me.timer);
            now = null;
            if (waiting !== undefined) {
                const next = waiting;
                waiting = undefined;
                run(next, me.why ? waits : undefined);
            }
            end();
        }
    }

    function cancel() {
        waiting = undefined;
        give("cancelled");
    }

    return {
        ask(input) {
            if (!now) run(input);
            else {
                waiting = input;
                hurry();
            }
        },
        cancel,
        get busy() {
            return now !== null;
        },
    };
}

const PATIENCE_MOST_MS = 1000;
const median = (list) => (list.length ? [...list].sort((a, b) => a - b)[list.length >> 1] : 0);
