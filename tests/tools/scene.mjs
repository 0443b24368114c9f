// Prints the scene of a web page in the packed notation: `node scene.mjs PAGE`. The page contains it in base 64,
// compressed by zlib.
import { readFileSync } from 'node:fs'
import { inflateSync } from 'node:zlib'

const [, text] = /id="scene">([^<]*)</.exec(readFileSync(process.argv[2], 'utf8'))
process.stdout.write(inflateSync(Buffer.from(text, 'base64')))
