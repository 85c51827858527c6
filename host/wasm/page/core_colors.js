// One colour for each context, far apart for neighbouring numbers.
export const COLORS = Array.from({length: 24}, (_, context) => {
    const lightness = [66, 74, 58][Math.floor(context / 8) % 3];
    return `hsl(${(context * 137.5 + 200) % 360} 85% ${lightness}%)`;
});
