// Serves the page to browsers on this machine: `node page/serve.js [PORT]`, 8000 if no port is given.
import {createServer} from 'node:http';
import {readFile} from 'node:fs/promises';
import {extname, join, normalize, sep} from 'node:path';
import {fileURLToPath} from 'node:url';

const TYPES = {'.html': 'text/html', '.css': 'text/css', '.js': 'text/javascript'};
const root = fileURLToPath(new URL('..', import.meta.url));

/** Answers a request with a file of the package. */
async function answer(request, response) {
    const {pathname} = new URL(request.url, 'http://localhost');
    if (pathname === '/') return response.writeHead(302, {location: '/page/index.html'}).end();
    const file = normalize(join(root, decodeURIComponent(pathname)));
    const type = TYPES[extname(file)];
    if (!file.startsWith(root + (root.endsWith(sep) ? '' : sep)) || !type) return response.writeHead(404).end();
    try {
        const bytes = await readFile(file);
        response.writeHead(200, {'content-type': `${type}; charset=utf-8`, 'cache-control': 'no-store'}).end(bytes);
    } catch {
        response.writeHead(404).end();
    }
}

/** Starts the server, and returns it with its address. Port 0 takes any free one. */
export async function serve(port) {
    const server = createServer((request, response) => answer(request, response).catch(() => response.writeHead(400).end()));
    await new Promise((resolve, reject) => server.once('error', reject).listen(port, '127.0.0.1', resolve));
    return {server, address: `http://127.0.0.1:${server.address().port}/`};
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
    const {address} = await serve(Number(process.argv[2] ?? 8000));
    console.log(`The page is at ${address}; Ctrl-C ends.`);
}
